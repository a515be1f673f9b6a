//! From how far the relief comes that clears a face of its reflected pressure.

use glam::DVec3;

use crate::geometry::Outline;

/// How the clearing length S of (2.31) is found.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Clearing {
    /// Per panel, its distance to the edge of all that stands together with its body, as the charge sees it;
    /// never less than the piece alone would have. A brick in a wall clears from the wall's edge.
    #[default]
    Assembly,
    /// Half the smaller frontal extent of the piece itself, as in the thesis.
    Piece,
    /// One length for all [m].
    Length(f64),
}

impl Clearing {
    /// Clearing length of a panel [m], given the outlines of its piece and of its assembly, and how far a wall around
    /// the assembly goes on [m].
    pub fn length(
        self,
        panel_centre: DVec3,
        piece_half_width: f64,
        assembly: &Outline,
        surround: f64,
    ) -> f64 {
        match self {
            Self::Assembly => assembly.distance_to_edge(panel_centre).max(piece_half_width) + surround,
            Self::Piece => piece_half_width,
            Self::Length(length) => length,
        }
    }
}
