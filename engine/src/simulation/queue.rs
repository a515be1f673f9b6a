//! The loads of one body, in the order in which they come.

use std::collections::BTreeMap;

use glam::DVec3;

use super::targets::Shot;
use crate::loading::{FaceHistory, Wind};

/// The loads of one body in the order of their arrival.
#[derive(Debug, Default)]
pub(super) struct LoadQueue {
    panels: Vec<PanelLoad>,
    /// Panels before this one have been loaded to the end.
    next: usize,
    pub winds: Vec<Wind>,
    /// Which charge each wind comes from.
    wind_charges: Vec<usize>,
    /// When the first load arrives and the last one ends [s].
    pub start: f64,
    pub end: f64,
}

/// Load of one charge on one panel, with its lever on the body, in principal axes.
#[derive(Debug)]
pub(super) struct PanelLoad {
    pub charge: usize,
    /// Number of the panel on the body.
    pub panel: usize,
    pub history: FaceHistory,
    /// Area × inward normal [m²].
    pub push: DVec3,
    /// Arm × push, with the art direction's rotation factor [m³].
    pub twist: DVec3,
    /// It counts only once the body is free: a neighbour or the ground lies against it until then.
    pub buried: bool,
}

impl LoadQueue {
    pub fn new(shots: impl Iterator<Item = Shot>) -> Self {
        let mut queue = Self::default();
        for shot in shots {
            queue.winds.extend(shot.wind);
            queue.wind_charges.resize(queue.winds.len(), shot.charge);
            queue.panels.extend(shot.panels);
        }
        queue.sort();
        queue
    }

    fn sort(&mut self) {
        self.panels.sort_by(|a, b| a.history.arrival().total_cmp(&b.history.arrival()));
        let spans = (self.panels.iter().map(|l| (l.history.arrival(), l.history.end())))
            .chain(self.winds.iter().map(|w| (w.arrival, w.end)));
        (self.start, self.end) = spans
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(start, end), (from, to)| {
                (start.min(from), end.max(to))
            });
    }

    /// Puts in the loads of one charge, in place of those it had.
    pub fn replace(&mut self, shot: Shot) {
        self.remove(shot.charge);
        self.winds.extend(shot.wind);
        self.wind_charges.resize(self.winds.len(), shot.charge);
        self.panels.extend(shot.panels);
        self.sort();
    }

    /// Takes out the loads of one charge.
    pub fn remove(&mut self, charge: usize) {
        self.panels.drain(..self.next);
        self.next = 0;
        self.panels.retain(|load| load.charge != charge);
        let mut from = self.wind_charges.iter();
        self.winds.retain(|_| from.next() != Some(&charge));
        self.wind_charges.retain(|&from| from != charge);
        self.sort();
    }

    /// Impulse [N s] and angular impulse [N m s] of all panels from `t0` to `t1`, in principal axes; `free` says
    /// whether those that were buried are laid bare.
    pub fn take(&mut self, t0: f64, t1: f64, free: bool) -> (DVec3, DVec3) {
        let (mut impulse, mut angular) = (DVec3::ZERO, DVec3::ZERO);
        let begun = self.panels[self.next..].iter().take_while(|load| load.history.arrival() < t1);
        for load in begun.filter(|load| free || !load.buried) {
            let strength = load.history.impulse(t0, t1);
            impulse += load.push * strength;
            angular += load.twist * strength;
        }
        while self.panels.get(self.next).is_some_and(|load| load.history.end() <= t1) {
            self.next += 1;
        }
        (impulse, angular)
    }

    /// Impulse [N s] of all panels from `t0` to `t1` along an axis of the body's own, each with its weight. Nothing is
    /// used up.
    pub fn weighted(&self, t0: f64, t1: f64, axis: DVec3, weight: impl Fn(usize) -> f64) -> f64 {
        let begun = self.panels.iter().take_while(|load| load.history.arrival() < t1);
        begun.map(|load| load.history.impulse(t0, t1) * load.push.dot(axis) * weight(load.panel)).sum()
    }

    /// The highest load of any charge on one side of the body along an axis of its own, if all the panels there had
    /// their highest load at once [N].
    pub fn highest(&self, axis: DVec3) -> f64 {
        let mut sums: BTreeMap<(usize, bool), f64> = BTreeMap::new();
        for load in &self.panels {
            let along = load.push.dot(axis);
            *sums.entry((load.charge, along > 0.0)).or_default() += load.history.peak() * along.abs();
        }
        sums.into_values().fold(0.0, f64::max)
    }

    /// When the last panel load before a time [s] came [s]; the first one if none has come yet.
    pub fn latest_arrival(&self, t: f64) -> f64 {
        let come = self.panels.partition_point(|load| load.history.arrival() <= t);
        self.panels.get(come.saturating_sub(1)).map_or(t, |load| load.history.arrival())
    }

    /// When the panel loads that act at a time [s] end, and those that come before they do [s].
    pub fn end_of(&self, t: f64) -> f64 {
        let mut end = t;
        for load in &self.panels {
            if load.history.arrival() > end {
                break;
            }
            end = end.max(load.history.end());
        }
        end
    }

    /// The panel load that comes first.
    pub fn first(&self) -> Option<&PanelLoad> {
        self.panels.first()
    }

    /// Whether any load acts between two times.
    pub fn acts(&self, t0: f64, t1: f64) -> bool {
        self.start < t1 && self.end > t0
    }

    /// The shortest wind on the body, or the shortest panel load where no wind is followed [s]; infinite without
    /// loads.
    pub fn shortest(&self) -> f64 {
        let panels = self.panels.iter().map(|l| l.history.end() - l.history.arrival());
        let winds = self.winds.iter().map(|w| w.end - w.arrival);
        if self.winds.is_empty() {
            panels.fold(f64::INFINITY, f64::min)
        } else {
            winds.fold(f64::INFINITY, f64::min)
        }
    }
}
