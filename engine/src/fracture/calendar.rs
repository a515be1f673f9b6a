//! The queue of coming events, earliest first.
//!
//! A calendar (Brown 1988): near events wait in narrow bins of time, and only those of the present bin are kept in a
//! heap. With a million tips on the way a single heap would be one cache miss a level; here it stays small.

use core::cmp::Ordering;
use std::collections::BinaryHeap;

/// How many bins there are.
const BINS: usize = 1024;

/// Something that is to happen.
#[derive(Debug, Clone, Copy)]
pub(super) struct Event<T> {
    /// When.
    pub time: f64,
    /// Of two at the same time, the lower number comes first.
    order: u32,
    /// What.
    pub what: T,
}

impl<T> PartialEq for Event<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl<T> Eq for Event<T> {}
impl<T> PartialOrd for Event<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl<T> Ord for Event<T> {
    /// The earliest is the greatest, as a heap wants it.
    fn cmp(&self, other: &Self) -> Ordering {
        other.time.total_cmp(&self.time).then(other.order.cmp(&self.order))
    }
}

/// Events in the order of their times, and at the same time in the order in which they were scheduled.
#[derive(Debug)]
pub(super) struct Calendar<T> {
    inverse_width: f64,
    /// Number of the present bin, counted from time 0.
    present: i64,
    now: BinaryHeap<Event<T>>,
    bins: Vec<Vec<Event<T>>>,
    in_bins: usize,
    /// Beyond the last bin.
    far: BinaryHeap<Event<T>>,
    order: u32,
}

impl<T: Copy> Calendar<T> {
    /// An empty calendar for events that mostly come within `horizon` of the present.
    pub fn new(horizon: f64) -> Self {
        Self {
            inverse_width: 0.25 * BINS as f64 / horizon,
            present: 0,
            now: BinaryHeap::new(),
            bins: (0..BINS).map(|_| Vec::new()).collect(),
            in_bins: 0,
            far: BinaryHeap::new(),
            order: 0,
        }
    }

    /// Adds an event.
    pub fn schedule(&mut self, time: f64, what: T) {
        let event = Event { time, order: self.order, what };
        self.order += 1;
        let bin = self.bin(time);
        if bin <= self.present {
            self.now.push(event);
        } else if bin < self.present + BINS as i64 {
            self.bins[bin as usize % BINS].push(event);
            self.in_bins += 1;
        } else {
            self.far.push(event);
        }
    }

    /// Takes the earliest event.
    pub fn pop(&mut self) -> Option<Event<T>> {
        while self.now.is_empty() {
            if self.in_bins == 0 {
                // Nothing is near: straight on to the next far one.
                let next = self.far.peek()?;
                self.present = self.bin(next.time);
            } else {
                self.present += 1;
            }
            while self.far.peek().is_some_and(|next| self.bin(next.time) <= self.present) {
                self.now.extend(self.far.pop());
            }
            let bin = &mut self.bins[self.present as usize % BINS];
            self.in_bins -= bin.len();
            self.now.extend(bin.drain(..));
        }
        self.now.pop()
    }

    fn bin(&self, time: f64) -> i64 {
        (time * self.inverse_width) as i64
    }
}
