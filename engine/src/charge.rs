//! Charges: what explodes, how much of it, where, when, and which curves describe its blast.
//!
//! Source: thesis Table 2.1 and §2.4.1, §2.5.1.

use std::sync::Arc;

use glam::DVec3;

use crate::error::{Error, Result, finite, not_negative, positive};

/// Density of cast TNT [kg/m³]: the size of a charge, from which its front starts.
pub const TNT_DENSITY: f64 = 1630.0;

/// Detonation velocity of cast TNT [m/s]: how soon the front leaves the charge.
pub const TNT_DETONATION_VELOCITY: f64 = 6930.0;

/// Energy factor of a surface burst against a free-air one (thesis §2.5.1): 2 for a perfect reflector.
pub const SURFACE_ENERGY_FACTOR: f64 = 1.8;

/// An explosive of Table 2.1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Explosive {
    /// The name that the thesis uses.
    pub name: &'static str,
    /// Other names for the same explosive.
    pub aliases: &'static [&'static str],
    /// Mass of TNT that carries the energy of 1 kg of this explosive [kg/kg].
    pub tnt_equivalence: f64,
}

const fn explosive(name: &'static str, aliases: &'static [&'static str], tnt_equivalence: f64) -> Explosive {
    Explosive { name, aliases, tnt_equivalence }
}

/// Table 2.1: TNT equivalence by energy per unit mass.
pub const EXPLOSIVES: [Explosive; 10] = [
    explosive("Amatol 80/20", &["Amatol"], 0.586),
    explosive("Compound B", &["Composition B", "Comp B"], 1.148),
    explosive("RDX", &["Cyclonite", "Hexogen", "RDX (Cyclonite)"], 1.185),
    explosive("HMX", &["Octogen"], 1.256),
    explosive("Mercury fulminate", &["Fulminate of mercury"], 0.395),
    explosive("Nitroglycerin", &["Nitroglycerine", "Nitroglycerin (liquid)"], 1.481),
    explosive("PETN", &["Penthrite"], 1.282),
    explosive("Pentolite 50/50", &["Pentolite"], 1.129),
    explosive("TNT", &["Trinitrotoluene"], 1.000),
    explosive("Torpex", &[], 1.667),
];

/// TNT equivalence [kg/kg] of a named explosive of Table 2.1; `None` if the name is not known.
///
/// Only letters and digits count, in any case: "pentolite 50/50", "Pentolite-5050" and "PENTOLITE" agree.
pub fn tnt_equivalence(name: &str) -> Option<f64> {
    EXPLOSIVES
        .iter()
        .find(|explosive| {
            same_name(explosive.name, name) || explosive.aliases.iter().any(|alias| same_name(alias, name))
        })
        .map(|explosive| explosive.tnt_equivalence)
}

fn same_name(left: &str, right: &str) -> bool {
    letters(left).eq(letters(right))
}

fn letters(text: &str) -> impl Iterator<Item = char> + '_ {
    text.chars().filter(|character| character.is_alphanumeric()).flat_map(char::to_lowercase)
}

/// Where a charge bursts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Burst {
    /// In free air, far from any surface: the blast is a sphere.
    #[default]
    Air,
    /// On the ground: the blast is a hemisphere, strengthened by the ground's reflection.
    Surface,
}

/// Which curves say how a charge's blast weakens with distance.
#[derive(Debug, Clone, Default)]
pub enum CurveSource {
    /// Kingery and Bulmash (1984): spherical for bursts in air, hemispherical on the surface.
    #[default]
    KingeryBulmash,
    /// Brode (1955), thesis (2.20), (2.21).
    Brode,
    /// Henrych (1979), thesis (2.22)–(2.24), the middle branch with its sign corrected.
    Henrych,
    /// Kinney and Graham (1985).
    KinneyGraham,
    /// Brisance's own hydrocode, spherical; computed once and stored.
    Hydrocode,
    /// The user's own samples, read log–log.
    Table(Arc<CurveTable>),
}

/// Samples of blast curves at rising scaled distances, for sea-level air and 1 kg of TNT.
///
/// Only `overpressure` must be there; see [`crate::blast::curves`] for what stands in for a missing column.
/// Every column has as many rows as `scaled_distance` and holds finite values above 0. The thesis asks for
/// at least ten samples a decade; [`CurveTable::samples_per_decade`] counts them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CurveTable {
    /// `Z` [m/kg^⅓], strictly increasing, two rows or more.
    pub scaled_distance: Vec<f64>,
    /// Peak static overpressure [Pa].
    pub overpressure: Vec<f64>,
    /// Peak overpressure on a wall struck head-on [Pa].
    pub reflected_pressure: Option<Vec<f64>>,
    /// Peak dynamic pressure [Pa].
    pub dynamic_pressure: Option<Vec<f64>>,
    /// Speed of the front [m/s].
    pub front_velocity: Option<Vec<f64>>,
    /// Duration of the positive phase [s/kg^⅓].
    pub duration: Option<Vec<f64>>,
    /// Impulse of the positive phase [Pa s/kg^⅓].
    pub impulse: Option<Vec<f64>>,
    /// Impulse of the positive phase on a wall struck head-on [Pa s/kg^⅓].
    pub reflected_impulse: Option<Vec<f64>>,
    /// Time from detonation to the front's arrival [s/kg^⅓], strictly increasing.
    pub arrival_time: Option<Vec<f64>>,
}

impl CurveTable {
    /// Average number of samples in a decade of scaled distance; the thesis takes ten or more.
    pub fn samples_per_decade(&self) -> f64 {
        match (self.scaled_distance.first(), self.scaled_distance.last()) {
            (Some(first), Some(last)) if last > first => {
                (self.scaled_distance.len() - 1) as f64 / libm::log10(last / first)
            }
            _ => 0.0,
        }
    }

    /// Checks every column: length, finite values above 0, strictly increasing distances and arrival times.
    pub fn validate(&self) -> Result<()> {
        if self.scaled_distance.len() < 2 {
            return Err(Error::Malformed(format!(
                "the curve table has {} rows, but must have at least 2",
                self.scaled_distance.len()
            )));
        }
        for (name, column) in self.columns() {
            self.check_column(name, column)?;
        }
        check_increasing("scaled_distance_m_kg13", &self.scaled_distance)?;
        self.arrival_time.as_ref().map_or(Ok(()), |times| check_increasing("arrival_time_s_kg13", times))
    }

    fn columns(&self) -> impl Iterator<Item = (&'static str, &[f64])> {
        let required =
            [("scaled_distance_m_kg13", &self.scaled_distance), ("overpressure_pa", &self.overpressure)];
        let optional = [
            ("reflected_pressure_pa", &self.reflected_pressure),
            ("dynamic_pressure_pa", &self.dynamic_pressure),
            ("front_velocity_m_s", &self.front_velocity),
            ("duration_s_kg13", &self.duration),
            ("impulse_pa_s_kg13", &self.impulse),
            ("reflected_impulse_pa_s_kg13", &self.reflected_impulse),
            ("arrival_time_s_kg13", &self.arrival_time),
        ];
        let optional = optional.into_iter().filter_map(|(name, column)| Some((name, column.as_ref()?)));
        required.into_iter().chain(optional).map(|(name, column)| (name, column.as_slice()))
    }

    fn check_column(&self, name: &str, column: &[f64]) -> Result<()> {
        if column.len() != self.scaled_distance.len() {
            return Err(Error::Malformed(format!(
                "the curve table's column {name} has {} rows, but must have {}, one for each scaled distance",
                column.len(),
                self.scaled_distance.len()
            )));
        }
        match column.iter().position(|value| !(value.is_finite() && *value > 0.0)) {
            None => Ok(()),
            Some(row) => Err(Error::Malformed(format!(
                "the curve table's column {name} holds {} in row {}, but must hold finite numbers above 0",
                column[row],
                row + 1
            ))),
        }
    }
}

fn check_increasing(name: &str, column: &[f64]) -> Result<()> {
    match column.windows(2).position(|pair| pair[1] <= pair[0]) {
        None => Ok(()),
        Some(row) => Err(Error::Malformed(format!(
            "the curve table's column {name} holds {} in row {} after {}, but must increase from row to row",
            column[row + 1],
            row + 2,
            column[row]
        ))),
    }
}

/// One charge in a scene.
#[derive(Debug, Clone)]
pub struct Charge {
    /// Mass of the explosive [kg], above 0.
    pub mass: f64,
    /// Mass of TNT that stands for 1 kg of it [kg/kg], above 0 (Table 2.1).
    pub tnt_equivalence: f64,
    /// Where it lies [m].
    pub position: DVec3,
    /// In free air or on the ground.
    pub burst: Burst,
    /// When it detonates [s] of scene time.
    pub time: f64,
    /// Art direction: multiplies every load from this charge, 0 or more; 1 is physical. Loads apply it; the
    /// blast field itself stays physical.
    pub gain: f64,
    /// The curves that describe its blast.
    pub curves: CurveSource,
}

impl Charge {
    /// `mass` [kg] of TNT at `position` [m]: in free air, detonating at time 0, Kingery–Bulmash curves.
    pub fn tnt(mass: f64, position: DVec3) -> Charge {
        Charge {
            mass,
            tnt_equivalence: 1.0,
            position,
            burst: Burst::Air,
            time: 0.0,
            gain: 1.0,
            curves: CurveSource::KingeryBulmash,
        }
    }

    /// Equivalent mass of TNT `W` [kg], before any factor for a surface burst.
    pub fn tnt_mass(&self) -> f64 {
        self.mass * self.tnt_equivalence
    }

    /// Radius [m] of a sphere of TNT of this charge's equivalent mass; of a hemisphere on the surface.
    pub fn radius(&self) -> f64 {
        let whole = match self.burst {
            Burst::Air => 1.0,
            Burst::Surface => 2.0,
        };
        libm::cbrt(whole * self.tnt_mass() * 3.0 / (4.0 * core::f64::consts::PI * TNT_DENSITY))
    }

    /// Checks every number and the curve table, if there is one.
    pub fn validate(&self) -> Result<()> {
        positive("charge mass [kg]", self.mass)?;
        positive("charge TNT equivalence", self.tnt_equivalence)?;
        for coordinate in self.position.to_array() {
            finite("charge position [m]", coordinate)?;
        }
        finite("charge detonation time [s]", self.time)?;
        not_negative("charge gain", self.gain)?;
        match &self.curves {
            CurveSource::Table(table) => table.validate(),
            _ => Ok(()),
        }
    }
}
