//! Cracks that run across from one radial crack to the next.

use super::{Growth, Happening, Kind, Sprout, direction};

impl Growth<'_> {
    /// Plans the rings that start from a new run.
    pub(super) fn seed_rings(&mut self, number: u32) {
        let (Some(rings), run) = (self.settings.rings, self.done.runs[number as usize]) else { return };
        let tip = self.done.tips[run.trace as usize];
        if tip.kind != Kind::Branch {
            return;
        }
        let start = self.trees[tip.tree as usize].start;
        let mut ring = tip.next_ring;
        let margin = 16.0 * self.done.resolution;
        loop {
            let radius = ring_radius(rings.spacing, rings.growth, ring);
            let at = start + radius * (1.0 + 0.1 * (self.draw(run.trace) - 0.5));
            if radius + start > run.to {
                break;
            }
            ring += 1;
            if at > run.from + margin && at < run.to - margin && self.draw(run.trace) < rings.share {
                let outward = (run.point(at) - self.trees[tip.tree as usize].origin).to_angle();
                let angle = outward + core::f64::consts::FRAC_PI_2 + 0.5 * (self.draw(run.trace) - 0.5);
                let gap = ring_radius(rings.spacing, rings.growth, ring) - radius;
                self.queue.schedule(at + gap, Happening::Ring { sprout: self.sprouts.len() as u32 });
                self.sprouts.push(Sprout { run: number, at, angle });
            }
        }
        self.done.tips[run.trace as usize].next_ring = ring;
    }

    pub(super) fn sprout(&mut self, sprout: Sprout, now: f64) {
        let run = self.done.runs[sprout.run as usize];
        if sprout.at > run.to - 16.0 * self.done.resolution {
            return;
        }
        let origin = run.point(sprout.at);
        let tree = self.done.tips[run.trace as usize].tree;
        // Where nothing stands across within the distance to the middle, there is no wedge to break.
        let heading = direction(sprout.angle);
        let widest = origin.distance(self.trees[tree as usize].origin);
        if self.has_room(sprout.run, sprout.at, heading, widest, now) {
            return;
        }
        let vertex = self.vertex(origin);
        self.mark(run.trace, sprout.at, vertex);
        let tip = self.new_tip(tree, 0, sprout.run, Kind::Ring, now);
        self.start(tip, origin, heading, vertex, sprout.run, now);
    }
}

fn ring_radius(spacing: f64, growth: f64, ring: u32) -> f64 {
    if growth == 1.0 {
        return spacing * f64::from(ring + 1);
    }
    spacing * (libm::pow(growth, f64::from(ring + 1)) - 1.0) / (growth - 1.0)
}
