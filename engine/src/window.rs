//! A brittle pane, perhaps in a frame: what a scene says of it (thesis chapter 6).

use glam::{DQuat, DVec3};

use crate::error::{Error, Result, not_negative, positive};
use crate::fracture::{Recipe, outline};
use crate::geometry::Polygon;
use crate::material::Material;

/// A pane that a blast may break.
#[derive(Debug, Clone)]
pub struct Window {
    /// Its outline in its own frame [m], whose origin is at [`position`](Self::position) and whose x and y axes span
    /// the pane: a simple polygon, counter-clockwise, holes clockwise.
    pub outline: Polygon,
    /// Thickness [m].
    pub thickness: f64,
    /// Where the origin of its frame is in the world [m].
    pub position: DVec3,
    /// Rotation from its frame into the world.
    pub orientation: DQuat,
    /// What it is made of.
    pub material: Material,
    /// Tensile stress at which it fails [Pa], wherever in it that is first reached.
    pub strength: f64,
    /// Whether it may break at all.
    pub may_break: bool,
    /// How it breaks. Seeds are in its own frame; without any, cracks start where the pane fails.
    pub recipe: Recipe,
    /// Whether the load says into how many pieces, by (2.45), in place of the recipe's fineness.
    pub by_load: bool,
    /// When pieces come free.
    pub release: Release,
    /// How deep the border lies in the rebate of a frame [m]; `None` without a frame.
    pub bite: Option<f64>,
    /// How far the wall around it goes on from its border [m]: from there the relief comes that clears it.
    pub facade: f64,
    /// What it stands together with, itself at least: without it `facade` does not count. See
    /// [`Body`](crate::scene::Body).
    pub assembly: Option<u32>,
    /// Whether it shelters what is behind it.
    pub occludes: bool,
    /// Whether its pieces may rotate.
    pub can_rotate: bool,
    /// Coefficient of friction of its pieces.
    pub friction: f64,
    /// Drag coefficient of its pieces.
    pub drag_coefficient: f64,
    /// Lift coefficient of its pieces; left out, as of any plate.
    pub lift_coefficient: Option<f64>,
}

/// When the pieces of a pane come free.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Release {
    /// The pane bends under the load until it fails; each piece is free when its outline has closed.
    #[default]
    AsItCracks,
    /// The pane is in pieces before the blast, as in the thesis: each is free when the front reaches it.
    AllAtOnce,
}

impl Window {
    /// Checks every number, and that the outline bounds a pane.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] or [`Error::Malformed`] for the first value without a meaning.
    pub fn validate(&self) -> Result<()> {
        outline::check(&self.outline)?;
        positive("thickness of the pane [m]", self.thickness)?;
        positive("strength of the pane [Pa]", self.strength)?;
        self.material.validate()?;
        if let Some(bite) = self.bite {
            not_negative("bite of the frame [m]", bite)?;
        }
        not_negative("facade around the pane [m]", self.facade)?;
        not_negative("friction", self.friction)?;
        not_negative("drag coefficient", self.drag_coefficient)?;
        if let Some(lift) = self.lift_coefficient {
            not_negative("lift coefficient", lift)?;
        }
        if !self.position.is_finite() || !self.orientation.is_finite() || !self.orientation.is_normalized() {
            return Err(Error::Malformed("a window's position and unit quaternion must be finite".into()));
        }
        Ok(())
    }
}
