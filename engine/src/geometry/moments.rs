//! Area, centroid and second moments of a plane figure, and of the prism that stands on it.
//!
//! Green's theorem turns each integral over the figure into a sum over its sides, exact for straight ones. The
//! thesis integrates triangle by triangle (6.2)–(6.10); the outline gives the same without cutting it up.

use glam::{DMat3, DVec2, DVec3};

use super::{MassProperties, Polygon};

/// Moments of a plane figure.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PlaneMoments {
    /// Area [m²].
    pub area: f64,
    /// Centroid [m] (6.7), (6.8).
    pub centroid: DVec2,
    /// `∫ x² dA` about the centroid [m⁴].
    pub xx: f64,
    /// `∫ y² dA` about the centroid [m⁴].
    pub yy: f64,
    /// `∫ x y dA` about the centroid [m⁴].
    pub xy: f64,
}

impl PlaneMoments {
    /// The moments of a polygon with its holes taken off; all 0 for an empty one.
    ///
    /// The first sums run about the polygon's first point and the second moments about its centroid, so neither
    /// the place in the pane nor a shift of axes costs digits. What rounding leaves is about `1e-16 · L/w` of
    /// the area for a sliver of length `L` and width `w` that lies aslant: its sides' products cancel.
    /// The polygon must have an area above 0, or the centroid is not a number.
    pub fn of(polygon: &Polygon) -> Self {
        let Some(&origin) = polygon.points().first() else { return Self::default() };
        let (mut twice_area, mut first) = (0.0, DVec2::ZERO);
        for (p, q) in polygon.sides() {
            let (p, q) = (p - origin, q - origin);
            let cross = p.perp_dot(q);
            twice_area += cross;
            first += (p + q) * cross;
        }
        let offset = first / (3.0 * twice_area);
        let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
        for (p, q) in polygon.sides() {
            let (p, q) = (p - origin - offset, q - origin - offset);
            let cross = p.perp_dot(q);
            xx += cross * (p.x * p.x + p.x * q.x + q.x * q.x);
            yy += cross * (p.y * p.y + p.y * q.y + q.y * q.y);
            xy += cross * (2.0 * (p.x * p.y + q.x * q.y) + p.x * q.y + q.x * p.y);
        }
        Self {
            area: 0.5 * twice_area,
            centroid: origin + offset,
            xx: xx / 12.0,
            yy: yy / 12.0,
            xy: xy / 24.0,
        }
    }

    /// The direction in which the figure is longest: the principal axis of the larger second moment, a unit
    /// vector with x > 0, or +y. A figure without a longest direction (a square, a disc) gets +x.
    pub fn long_axis(&self) -> DVec2 {
        let half = 0.5 * (self.xx - self.yy);
        let radius = libm::sqrt(half * half + self.xy * self.xy);
        // Of two parallel forms of the eigenvector, the one whose sum does not cancel.
        let axis =
            if half >= 0.0 { DVec2::new(radius + half, self.xy) } else { DVec2::new(self.xy, radius - half) };
        let axis = axis.try_normalize().unwrap_or(DVec2::X);
        if axis.x < 0.0 || (axis.x == 0.0 && axis.y < 0.0) { -axis } else { axis }
    }

    /// Second moments `∫ u² dA` along the [`long_axis`](Self::long_axis) and across it [m⁴].
    pub fn principal(&self) -> [f64; 2] {
        let middle = 0.5 * (self.xx + self.yy);
        let half = 0.5 * (self.xx - self.yy);
        let radius = libm::sqrt(half * half + self.xy * self.xy);
        [middle + radius, (middle - radius).max(0.0)]
    }

    /// Mass, centre and inertia of the prism on this figure: `thickness` [m] symmetric about z = 0, `density`
    /// [kg/m³], both above 0.
    ///
    /// The corrected (6.2)–(6.5) summed over the figure; (6.6) makes the entries with one z vanish.
    pub fn prism(&self, thickness: f64, density: f64) -> MassProperties {
        let surface_density = density * thickness;
        let mass = surface_density * self.area;
        let through = mass * thickness * thickness / 12.0;
        let (xx, yy, xy) = (surface_density * self.xx, surface_density * self.yy, surface_density * self.xy);
        MassProperties {
            mass,
            centre: self.centroid.extend(0.0),
            inertia: DMat3::from_cols(
                DVec3::new(yy + through, -xy, 0.0),
                DVec3::new(-xy, xx + through, 0.0),
                DVec3::new(0.0, 0.0, xx + yy),
            ),
        }
    }
}
