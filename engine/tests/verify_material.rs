//! Brittle materials against the published table, and their formulas against closed forms and numbers worked out
//! elsewhere.

use brisance_engine::Error;
use brisance_engine::material::{
    CONCRETE, GLASS, LEAST_MEAN_AREA, MATERIALS, Material, PORCELAIN, mean_fragment_area,
    mean_fragment_velocity, stress_intensity,
};
use proptest::prelude::*;

/// The published value of a property, in SI units.
fn published(material: &str, property: &str) -> f64 {
    let unit = |name: &str| match name {
        "GPa" => 1e9,
        "MPa" | "MPa m^0.5" => 1e6,
        "um" => 1e-6,
        "kg/m3" | "J/m2" | "m/s" | "-" => 1.0,
        _ => panic!("a unit that is not expected here: {name}"),
    };
    let rows: Vec<Vec<&str>> =
        include_str!("../data/materials.csv").lines().map(|line| line.split(',').collect()).collect();
    let row = rows.iter().find(|row| row[0] == material && row[1] == property);
    let row = row.unwrap_or_else(|| panic!("no {property} of {material}"));
    row[2].parse::<f64>().unwrap() * unit(row[3])
}

#[test]
fn every_value_is_the_published_one() {
    let glass = "soda-lime glass";
    let concrete = "concrete C25/30";
    let brick = "clay brick unit";
    let porcelain = "porcelain / whiteware";
    let expected = [
        Material {
            density: published(glass, "density"),
            young_modulus: published(glass, "Young modulus"),
            poisson_ratio: Some(published(glass, "Poisson ratio")),
            fracture_energy: Some(published(glass, "Gc")),
            toughness: Some(published(glass, "K_Ic")),
            tensile_strength: published(glass, "tensile strength (annealed; design)"),
            crack_speed: Some(published(glass, "terminal crack speed")),
        },
        Material {
            density: published(concrete, "density"),
            young_modulus: published(concrete, "Young modulus"),
            poisson_ratio: Some(published(concrete, "Poisson ratio")),
            fracture_energy: Some(published(concrete, "fracture energy G_F")),
            toughness: Some(published("concrete", "K_Ic")),
            tensile_strength: published(concrete, "tensile strength (mean)"),
            crack_speed: Some(published("concrete", "observed crack speed")),
        },
        Material {
            density: published(brick, "density"),
            young_modulus: published(brick, "Young modulus"),
            poisson_ratio: None,
            fracture_energy: Some(published(brick, "fracture energy G_F")),
            toughness: None,
            tensile_strength: published(brick, "tensile strength"),
            crack_speed: None,
        },
        Material {
            density: published(porcelain, "density"),
            young_modulus: published(porcelain, "Young modulus"),
            poisson_ratio: None,
            fracture_energy: None,
            toughness: Some(published(porcelain, "K_Ic")),
            tensile_strength: published(porcelain, "tensile (flexural) strength"),
            crack_speed: None,
        },
        Material {
            density: published("alumina", "density"),
            young_modulus: published("alumina", "Young modulus"),
            poisson_ratio: None,
            fracture_energy: None,
            toughness: Some(published("alumina", "K_Ic")),
            tensile_strength: published("alumina", "flexural strength"),
            crack_speed: None,
        },
        Material {
            density: published("pine", "density"),
            young_modulus: published("pine (along grain)", "Young modulus"),
            poisson_ratio: None,
            fracture_energy: None,
            toughness: Some(published("pine (crack across grain)", "K_Ic")),
            tensile_strength: published("pine (along grain)", "tensile strength"),
            crack_speed: None,
        },
    ];
    assert_eq!(MATERIALS.map(|(_, material)| material), expected);
    for (name, material) in MATERIALS {
        material.validate().unwrap();
        assert_eq!(Material::named(&name.to_uppercase()), Some(material));
    }
    assert_eq!(Material::named("gl"), None);
}

#[test]
fn glass_has_the_flaws_and_the_toughness_of_the_table() {
    // A scratch at the border of a plate has 1.12 times the stress intensity: 70 µm at the design strength.
    let flaw = GLASS.critical_length(1.12 * GLASS.tensile_strength);
    assert!((flaw / published("soda-lime glass", "characteristic surface flaw depth") - 1.0).abs() < 0.01);
    // √(E G_c) = √(72e9 · 9) = 804 984 Pa √m: within 8 % of the measured toughness.
    let from_energy = Material { toughness: None, ..GLASS }.critical_stress_intensity();
    assert!((from_energy - 804_984.47).abs() < 0.01);
    assert!((from_energy / GLASS.critical_stress_intensity() - 1.0).abs() < 0.08);
    // And back: K_c²/E = 0.75e6²/72e9.
    assert!((Material { fracture_energy: None, ..GLASS }.critical_energy_release() - 7.8125).abs() < 1e-12);
    // The thesis: about 10 J/m² for glass.
    assert!((GLASS.critical_energy_release() - 10.0).abs() <= 1.0);
}

#[test]
fn waves_and_cracks_have_the_speeds_of_5_6() {
    // √(72e9/2500) = 5 366.563 m/s.
    assert!((GLASS.wave_speed() - 5_366.563_146).abs() < 1e-6);
    assert!((GLASS.energetic_crack_speed() - 0.38 * 5_366.563_146).abs() < 1e-6);
    // The thesis: (5.6) overestimates, measured speeds are 0.20 to 0.37 of the wave's, and glass has 1 500 m/s.
    assert_eq!(GLASS.terminal_crack_speed(), 1500.0);
    assert!((0.20..=0.37).contains(&(GLASS.terminal_crack_speed() / GLASS.wave_speed())));
    assert_eq!(PORCELAIN.terminal_crack_speed(), PORCELAIN.energetic_crack_speed());
    assert_eq!(GLASS.crack_speed(0.5e-3, 1e-3), 0.0);
    assert_eq!(GLASS.crack_speed(1e-3, 1e-3), 0.0);
    assert!((GLASS.crack_speed(2e-3, 1e-3) - 750.0).abs() < 1e-9);
    assert!((GLASS.crack_speed(1.0, 1e-3) - 1498.5).abs() < 1e-9);
    // A crack of no critical length, as in a plate under any stress, runs at full speed at once.
    assert_eq!(GLASS.crack_speed(1e-6, 0.0), 1500.0);
}

#[test]
fn the_energy_balance_and_the_stress_intensity_agree_on_when_a_crack_runs() {
    // In a plate held at its ends no work is done, and a crack that grows by da sets G T da of stored energy free.
    let glass = Material { fracture_energy: None, ..GLASS };
    let (stress, thickness, growth) = (20e6, 0.006, 1e-6);
    let critical = glass.critical_length(stress);
    assert!((stress_intensity(stress, critical) - 0.75e6).abs() < 1e-6);
    for (share, runs) in [(0.99, false), (1.01, true), (3.0, true)] {
        let freed = glass.energy_release(stress, share * critical) * thickness * growth;
        assert_eq!(glass.may_advance(0.0, -freed, thickness, growth), runs);
        // With dead weights in place of grips the loads do twice that work, and half of it is stored.
        assert_eq!(glass.may_advance(2.0 * freed, freed, thickness, growth), runs);
    }
    assert_eq!(glass.critical_length(0.0), f64::INFINITY);
    assert_eq!(glass.critical_length(-1e6), f64::INFINITY);
}

#[test]
fn fragment_areas_2_45() {
    // exp(2.4 − √12.5) · 645.16 mm² = 207.258 mm²: the largest mean that it gives.
    let still = mean_fragment_area(0.0).unwrap();
    assert!((still.area - 207.258_01e-6).abs() < 1e-11 && !still.is_floor());
    // 50 kPa: (5.8566e-5 · 5e4)² = 8.5749; √21.0749 = 4.59074; e^(−2.19074) · 645.16 mm² = 72.150 mm²,
    // some 14 000 pieces in a square metre.
    let strong = mean_fragment_area(50e3).unwrap();
    assert!((strong.area - 72.150e-6).abs() < 1e-9);
    assert!((1.0 / strong.area - 14e3).abs() < 500.0);
    // It passes 1 mm² at 139 kPa; beyond, the formula is told but not followed.
    assert!(!mean_fragment_area(138.8e3).unwrap().is_floor());
    let floor = mean_fragment_area(139e3).unwrap();
    assert!(floor.is_floor() && floor.area == LEAST_MEAN_AREA && floor.formula < 1e-6);
    // At the end of the range of (2.46) it is smaller than an atom: 1.8e-20 m².
    let end = mean_fragment_area(689e3).unwrap();
    assert!(end.area == LEAST_MEAN_AREA && (end.formula / 1.8206e-20 - 1.0).abs() < 1e-3);
    for pressure in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(mean_fragment_area(pressure).is_err());
    }
}

#[test]
fn fragment_velocities_2_46() {
    // 10 kPa on 6 mm: 0.3443 · 10 000^0.547 = 0.3443 · 10^2.188 = 53.08; 0.2539 + 1.826e-4 · 0.005238^−0.928 =
    // 0.2539 + 0.02389: 14.745 m/s.
    assert!((mean_fragment_velocity(10e3, 0.006).unwrap() - 14.745).abs() < 1e-3);
    assert!((mean_fragment_velocity(100e3, 0.006).unwrap() - 51.957).abs() < 1e-3);
    // Thinner is faster.
    assert!((mean_fragment_velocity(10e3, 0.003).unwrap() - 16.268).abs() < 1e-3);
    for pressure in [689.0, 690e3, f64::NAN] {
        assert!(matches!(mean_fragment_velocity(pressure, 0.006), Err(Error::OutOfRange { .. })));
    }
    for thickness in [7.62e-4, 0.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(mean_fragment_velocity(10e3, thickness), Err(Error::OutOfRange { .. })));
    }
}

#[test]
fn what_cannot_be_a_material_is_refused() {
    let refused = [
        Material { density: 0.0, ..GLASS },
        Material { young_modulus: f64::NAN, ..GLASS },
        Material { poisson_ratio: Some(0.5), ..GLASS },
        Material { poisson_ratio: Some(f64::NAN), ..GLASS },
        Material { fracture_energy: Some(-1.0), ..GLASS },
        Material { toughness: Some(0.0), ..GLASS },
        Material { toughness: None, fracture_energy: None, ..GLASS },
        Material { tensile_strength: f64::INFINITY, ..GLASS },
        Material { crack_speed: Some(0.0), ..GLASS },
    ];
    for material in refused {
        assert!(material.validate().is_err(), "{material:?}");
    }
    let message = Material { density: -2.0, ..CONCRETE }.validate().unwrap_err().to_string();
    assert_eq!(message, "material density [kg/m³] is -2, but must be a finite number greater than 0");
}

proptest! {
    /// (5.5) and its two inverses; (5.3) and its inverse.
    #[test]
    fn stress_and_length_invert_each_other(stress in 1e5f64..1e9, which in 0..MATERIALS.len()) {
        let material = MATERIALS[which].1;
        let length = material.critical_length(stress);
        prop_assert!((material.critical_stress(length) / stress - 1.0).abs() < 1e-14);
        prop_assert!((stress_intensity(stress, length) / material.critical_stress_intensity() - 1.0).abs() < 1e-14);
        prop_assert!((material.stress(material.strain(stress)) / stress - 1.0).abs() < 1e-15);
        // (Fig. 5.5) n times the length feeds n cracks.
        let once = material.energy_release(stress, length);
        prop_assert!((material.energy_release(stress, 3.0 * length) / once - 3.0).abs() < 1e-13);
    }

    /// More pressure makes smaller and faster fragments.
    #[test]
    fn fragments_follow_the_pressure(pressure in 690f64..600e3, thickness in 0.001f64..0.02) {
        let more = 1.1 * pressure;
        prop_assert!(mean_fragment_area(more).unwrap().formula < mean_fragment_area(pressure).unwrap().formula);
        let [slow, fast] = [pressure, more].map(|p| mean_fragment_velocity(p, thickness).unwrap());
        prop_assert!((fast / slow / 1.1f64.powf(0.547) - 1.0).abs() < 1e-12);
    }
}
