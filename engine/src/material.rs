//! Brittle materials: how stiff, how heavy and how tough they are, and what follows for cracks.
//!
//! Source: thesis 5.2 (5.3)–(5.6), and 2.11 (2.45), (2.46) for the glass of windows. Values and where each comes
//! from are in `data/materials.csv`. Its column `status` says how far to trust them: *confirmed* values were read
//! in a public text, *recalled* ones are quoted from standard references and worth a check before relying on them.
//!
//! All of it holds for a crack through a thin, brittle, elastic plate. Concrete, brick and wood are only nearly
//! that: much of their fracture energy is spent away from the tip, so that their toughness and `√(E G_c)` disagree.

use core::f64::consts::PI;

use crate::error::{Error, Result, not_negative, positive};

/// The share of the wave speed at which energy alone would let a crack run (5.6).
const ENERGETIC_SHARE: f64 = 0.38;

/// A brittle material. What is not known of it is `None`, and then follows from the rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Density ρ [kg/m³], above 0.
    pub density: f64,
    /// Young's modulus E [Pa], above 0.
    pub young_modulus: f64,
    /// Poisson's ratio ν, above −1 and below 0.5.
    pub poisson_ratio: Option<f64>,
    /// Energy that a crack takes per area, `G_c` [J/m²], above 0; left out: `K_c²/E`.
    pub fracture_energy: Option<f64>,
    /// Critical stress intensity `K_c` [Pa √m], above 0; left out: `√(E G_c)`. One of the two must be given.
    pub toughness: Option<f64>,
    /// Tensile strength of the material as it is used, with the flaws that it usually has [Pa], above 0.
    pub tensile_strength: f64,
    /// Measured speed of the fastest cracks [m/s], above 0; left out: 0.38 of the wave speed.
    pub crack_speed: Option<f64>,
}

/// Soda-lime float glass, annealed: windows.
///
/// Confirmed: E, G_c; recalled: ρ, ν 0.23 (other texts 0.20 and 0.25), K_c (`√(E G_c)` gives 0.80), the strength (a
/// design value; 30 MPa is confirmed as another) and the crack speed.
pub const GLASS: Material = Material {
    density: 2500.0,
    young_modulus: 72e9,
    poisson_ratio: Some(0.23),
    fracture_energy: Some(9.0),
    toughness: Some(0.75e6),
    tensile_strength: 45e6,
    crack_speed: Some(1500.0),
};

/// Concrete C25/30. All recalled; the crack speed with low confidence (100 to 1 000 m/s observed).
///
/// G_c is the whole fracture energy G_F, most of which goes into the zone around the crack: `√(E G_F)` is five times
/// the toughness of the tip.
pub const CONCRETE: Material = Material {
    density: 2400.0,
    young_modulus: 31e9,
    poisson_ratio: Some(0.2),
    fracture_energy: Some(137.0),
    toughness: Some(0.4e6),
    tensile_strength: 2.6e6,
    crack_speed: Some(500.0),
};

/// A clay brick. Confirmed in a restatement: strength and G_F; recalled: ρ and E. Its toughness follows from G_F, so
/// it is an upper bound.
pub const BRICK: Material = Material {
    density: 1900.0,
    young_modulus: 16.7e9,
    poisson_ratio: None,
    fracture_energy: Some(80.0),
    toughness: None,
    tensile_strength: 2e6,
    crack_speed: None,
};

/// Porcelain and other whiteware. All recalled.
pub const PORCELAIN: Material = Material {
    density: 2400.0,
    young_modulus: 70e9,
    poisson_ratio: None,
    fracture_energy: None,
    toughness: Some(1.2e6),
    tensile_strength: 70e6,
    crack_speed: None,
};

/// Dense alumina. All recalled; the strength is that in bending.
pub const ALUMINA: Material = Material {
    density: 3900.0,
    young_modulus: 380e9,
    poisson_ratio: None,
    fracture_energy: None,
    toughness: Some(3.8e6),
    tensile_strength: 350e6,
    crack_speed: None,
};

/// Pine, stressed along the grain and broken across it. All recalled. Wood is not the same in all directions, and
/// along the grain it splits at a tenth of this toughness.
pub const PINE: Material = Material {
    density: 480.0,
    young_modulus: 11e9,
    poisson_ratio: None,
    fracture_energy: None,
    toughness: Some(6e6),
    tensile_strength: 60e6,
    crack_speed: None,
};

/// The materials by the names that a scene uses.
pub const MATERIALS: [(&str, Material); 6] = [
    ("glass", GLASS),
    ("concrete", CONCRETE),
    ("brick", BRICK),
    ("porcelain", PORCELAIN),
    ("alumina", ALUMINA),
    ("pine", PINE),
];

impl Material {
    /// The material of this name among [`MATERIALS`]; `None` if it is not one of them.
    pub fn named(name: &str) -> Option<Material> {
        MATERIALS.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, material)| *material)
    }

    /// Checks every number, and that toughness or fracture energy is given.
    pub fn validate(&self) -> Result<()> {
        positive("material density [kg/m³]", self.density)?;
        positive("material Young's modulus [Pa]", self.young_modulus)?;
        positive("material tensile strength [Pa]", self.tensile_strength)?;
        let optional = [
            ("material fracture energy [J/m²]", self.fracture_energy),
            ("material toughness [Pa √m]", self.toughness),
            ("material crack speed [m/s]", self.crack_speed),
        ];
        for (what, value) in optional {
            value.map_or(Ok(0.0), |value| positive(what, value))?;
        }
        match self.poisson_ratio {
            Some(ratio) if !(ratio > -1.0 && ratio < 0.5) => Err(Error::OutOfRange {
                what: "material Poisson's ratio",
                value: ratio,
                expected: "above -1 and below 0.5",
            }),
            _ if self.fracture_energy.is_none() && self.toughness.is_none() => {
                Err(Error::Malformed("a material needs a fracture energy or a toughness".into()))
            }
            _ => Ok(()),
        }
    }

    /// Stress [Pa] at an elastic strain (5.3), tension above 0.
    pub fn stress(&self, strain: f64) -> f64 {
        self.young_modulus * strain
    }

    /// Elastic strain (5.2) at a stress [Pa], tension above 0.
    pub fn strain(&self, stress: f64) -> f64 {
        stress / self.young_modulus
    }

    /// `K_c` [Pa √m]: at this stress intensity a crack runs. From `K_c = √(E G_c)` where only the energy is known;
    /// not a number where neither is.
    pub fn critical_stress_intensity(&self) -> f64 {
        let from_energy = |energy| libm::sqrt(self.young_modulus * energy);
        self.toughness.or(self.fracture_energy.map(from_energy)).unwrap_or(f64::NAN)
    }

    /// `G_c` [J/m²]: the energy that must be released for each area of crack. From `K_c²/E` where only the toughness
    /// is known; not a number where neither is.
    pub fn critical_energy_release(&self) -> f64 {
        let from_toughness = |toughness| toughness * toughness / self.young_modulus;
        self.fracture_energy.or(self.toughness.map(from_toughness)).unwrap_or(f64::NAN)
    }

    /// The crack that a tensile stress [Pa] just makes run: `a_c = (K_c/σ)²/π` [m], from (5.5).
    ///
    /// Infinite without tension. The stress is that in the plate, in bending for a window, not the pressure of the air.
    pub fn critical_length(&self, stress: f64) -> f64 {
        if stress <= 0.0 {
            return f64::INFINITY;
        }
        let ratio = self.critical_stress_intensity() / stress;
        ratio * ratio / PI
    }

    /// The stress [Pa] that just makes a crack of `length` [m, above 0] run: `K_c/√(πa)`, from (5.5).
    pub fn critical_stress(&self, length: f64) -> f64 {
        self.critical_stress_intensity() / libm::sqrt(PI * length)
    }

    /// Energy `G = K²/E` [J/m²] that a crack of `length` [m] under `stress` [Pa] releases for each area it grows by.
    ///
    /// It grows with the length, so at `n` times the critical length it would feed `n` cracks (Fig. 5.5).
    pub fn energy_release(&self, stress: f64, length: f64) -> f64 {
        let intensity = stress_intensity(stress, length);
        intensity * intensity / self.young_modulus
    }

    /// Whether the energy balance (5.4) lets a crack advance by `growth` [m] through a plate of `thickness` [m]: the
    /// `work` done by the loads [J] must pay for the `elastic` energy stored meanwhile [J, below 0 where it is set
    /// free] and for the new area of crack.
    pub fn may_advance(&self, work: f64, elastic: f64, thickness: f64, growth: f64) -> bool {
        work >= elastic + self.critical_energy_release() * thickness * growth
    }

    /// Speed `v₁ = √(E/ρ)` [m/s] of a stretching wave along a bar: the elastic velocity of (5.6).
    ///
    /// A plate's and a block's waves are faster by a few percent to a third, depending on Poisson's ratio. The bar's
    /// is meant: the factor 0.38 was derived for it (Roberts and Wells 1954, after Mott 1948), and only with it
    /// do the thesis's crack speeds of glass (1 500 m/s) and steel (1 000 m/s) lie within its own 0.20 to 0.37 of v₁.
    pub fn wave_speed(&self) -> f64 {
        libm::sqrt(self.young_modulus / self.density)
    }

    /// Terminal speed [m/s] that (5.6) gives, `0.38 v₁`: too high, as the thesis says, by about a third for glass.
    pub fn energetic_crack_speed(&self) -> f64 {
        ENERGETIC_SHARE * self.wave_speed()
    }

    /// Terminal speed [m/s]: the measured one, or that of (5.6) where none is known.
    pub fn terminal_crack_speed(&self) -> f64 {
        self.crack_speed.unwrap_or_else(|| self.energetic_crack_speed())
    }

    /// Speed [m/s] of a crack of `length` [m] that began to run at `critical_length` [m] (5.6), with the
    /// [`terminal_crack_speed`](Self::terminal_crack_speed) in place of `0.38 v₁`. 0 up to the critical length.
    pub fn crack_speed(&self, length: f64, critical_length: f64) -> f64 {
        if length <= critical_length {
            return 0.0;
        }
        self.terminal_crack_speed() * (1.0 - critical_length / length)
    }
}

/// Stress intensity `K = σ√(πa)` [Pa √m] (5.5) of a crack of length `a` [m] across a tensile stress [Pa].
///
/// `a` is the half length of a crack inside a plate, or the whole length of one that starts from its border (which
/// has 1.12 times this). It is much longer than the plate is thick, and much shorter than it is wide.
pub fn stress_intensity(stress: f64, length: f64) -> f64 {
    stress * libm::sqrt(PI * length)
}

/// The smallest mean area [m²] that [`mean_fragment_area`] gives: 1 mm².
///
/// (2.45) was fitted to fragments that were found and counted. It passes 1 mm² at 139 kPa and falls to 2·10⁻²⁰ m², less
/// than an atom's, at the 689 kPa to which (2.46) reaches. A square millimetre is smaller than common panes are thick: such grains are dust to look at, and a square
/// metre of them is a million pieces.
pub const LEAST_MEAN_AREA: f64 = 1e-6;

/// Peak pressures on windows [Pa] whose fragments were measured (2.46).
pub const FRAGMENT_PRESSURES: core::ops::RangeInclusive<f64> = 690.0..=689e3;

/// Mean frontal area of the fragments of a window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanFragmentArea {
    /// The area to use [m²].
    pub area: f64,
    /// What (2.45) says [m²]: below the other where that is held at [`LEAST_MEAN_AREA`], which a run should warn of.
    pub formula: f64,
}

impl MeanFragmentArea {
    /// Whether the formula was left for the floor.
    pub fn is_floor(&self) -> bool {
        self.formula < self.area
    }
}

/// Mean frontal area of glass fragments (2.45) under a peak pressure [Pa, 0 or more] on the window: the reflected one
/// where it faces the charge, the static one on a side. At most 207 mm², at least [`LEAST_MEAN_AREA`].
///
/// # Errors
/// [`Error::OutOfRange`] for a pressure below 0 or not finite.
pub fn mean_fragment_area(pressure: f64) -> Result<MeanFragmentArea> {
    not_negative("peak pressure on the window [Pa]", pressure)?;
    let load = 5.8566e-5 * pressure;
    let formula = 6.4516e-4 * libm::exp(2.4 - libm::sqrt(12.5 + load * load));
    Ok(MeanFragmentArea { area: formula.max(LEAST_MEAN_AREA), formula })
}

/// Mean velocity of glass fragments (2.46) [m/s], from the peak pressure on the window [Pa] and its thickness [m].
///
/// It knows only the pressure, so it speaks of long pulses: a short one of the same pressure throws slower.
///
/// # Errors
/// [`Error::OutOfRange`] outside the range of the measurements: 690 Pa to 689 kPa, and thicker than 0.762 mm (where
/// the formula is infinite).
pub fn mean_fragment_velocity(pressure: f64, thickness: f64) -> Result<f64> {
    if !FRAGMENT_PRESSURES.contains(&pressure) {
        return Err(Error::OutOfRange {
            what: "peak pressure on the window [Pa]",
            value: pressure,
            expected: "from 690 to 689 000, where fragments were measured",
        });
    }
    let beyond = thickness - 7.62e-4;
    if !(beyond > 0.0 && beyond.is_finite()) {
        return Err(Error::OutOfRange {
            what: "thickness of the window [m]",
            value: thickness,
            expected: "finite and greater than 0.000762",
        });
    }
    Ok((0.2539 + 1.826e-4 * libm::pow(beyond, -0.928)) * (0.3443 * libm::pow(pressure, 0.547)))
}
