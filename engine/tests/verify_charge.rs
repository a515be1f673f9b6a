//! Charges against Table 2.1 and the scaling laws of thesis §2.4.1.

use std::sync::Arc;

use brisance_engine::blast::curves::{equivalent_distance, scaled_distance};
use brisance_engine::charge::{Burst, Charge, CurveSource, CurveTable, EXPLOSIVES, tnt_equivalence};
use glam::DVec3;

#[test]
fn table_2_1() {
    let table = [
        ("Amatol 80/20", 0.586),
        ("Compound B", 1.148),
        ("RDX", 1.185),
        ("HMX", 1.256),
        ("Mercury fulminate", 0.395),
        ("Nitroglycerin", 1.481),
        ("PETN", 1.282),
        ("Pentolite 50/50", 1.129),
        ("TNT", 1.000),
        ("Torpex", 1.667),
    ];
    assert_eq!(EXPLOSIVES.len(), table.len());
    for (explosive, (name, factor)) in EXPLOSIVES.iter().zip(table) {
        assert_eq!((explosive.name, explosive.tnt_equivalence), (name, factor));
        assert_eq!(tnt_equivalence(name), Some(factor));
    }
}

#[test]
fn names_are_forgiving_but_not_guessed() {
    for (name, factor) in [
        ("composition b", 1.148),
        ("Comp-B", 1.148),
        ("cyclonite", 1.185),
        ("RDX (Cyclonite)", 1.185),
        ("nitroglycerin (liquid)", 1.481),
        ("PENTOLITE", 1.129),
        ("pentolite 50/50", 1.129),
        ("tnt", 1.0),
    ] {
        assert_eq!(tnt_equivalence(name), Some(factor), "{name}");
    }
    for name in ["", "TN", "TNTT", "semtex", "C4"] {
        assert_eq!(tnt_equivalence(name), None, "{name}");
    }
}

#[test]
fn every_name_and_alias_means_one_explosive() {
    for explosive in &EXPLOSIVES {
        for name in explosive.aliases.iter().chain([&explosive.name]) {
            assert_eq!(tnt_equivalence(name), Some(explosive.tnt_equivalence), "{name}");
        }
    }
}

#[test]
fn scaled_distance_and_cross_scaling() {
    // (2.18): 8 kg has the cube root 2. (2.19): equal Z at R1/R2 = (W1/W2)^⅓.
    assert_eq!(scaled_distance(10.0, 8.0), 5.0);
    assert_eq!(equivalent_distance(10.0, 1.0, 27.0), 30.0);
    let (distance, mass, other) = (7.0, 3.0, 11.0);
    let z = scaled_distance(equivalent_distance(distance, mass, other), other);
    assert!((z - scaled_distance(distance, mass)).abs() < 1e-14);
}

#[test]
fn the_charge_itself_has_the_size_of_its_tnt() {
    // 1 kg at 1630 kg/m³ fills a sphere of 52.7 mm, or a hemisphere of 66.4 mm.
    let air = Charge::tnt(1.0, DVec3::ZERO);
    let surface = Charge { burst: Burst::Surface, ..air.clone() };
    assert!((air.radius() - 0.0527).abs() < 5e-5);
    assert!((surface.radius() - 0.0664).abs() < 5e-5);
    assert_eq!(Charge { mass: 2.0, tnt_equivalence: 1.5, ..air }.tnt_mass(), 3.0);
}

#[test]
fn charges_that_cannot_be_are_refused() {
    let good = Charge::tnt(1.0, DVec3::ZERO);
    assert!(good.validate().is_ok());
    let bad = [
        Charge { mass: 0.0, ..good.clone() },
        Charge { mass: f64::INFINITY, ..good.clone() },
        Charge { tnt_equivalence: -1.0, ..good.clone() },
        Charge { position: DVec3::new(0.0, f64::NAN, 0.0), ..good.clone() },
        Charge { time: f64::NAN, ..good.clone() },
        Charge { gain: -0.1, ..good.clone() },
        Charge { curves: CurveSource::Table(Arc::new(CurveTable::default())), ..good.clone() },
    ];
    for charge in bad {
        assert!(charge.validate().is_err(), "{charge:?}");
    }
}

#[test]
fn a_bad_curve_table_is_refused_in_one_sentence_that_names_column_and_row() {
    let good = CurveTable {
        scaled_distance: vec![1.0, 2.0, 4.0],
        overpressure: vec![9e5, 2e5, 5e4],
        ..CurveTable::default()
    };
    assert!(good.validate().is_ok());
    let message = |table: CurveTable| table.validate().unwrap_err().to_string();
    let short = CurveTable { scaled_distance: vec![1.0], overpressure: vec![1.0], ..good.clone() };
    assert_eq!(message(short), "the curve table has 1 rows, but must have at least 2");
    let falling = CurveTable { scaled_distance: vec![1.0, 1.0, 4.0], ..good.clone() };
    assert!(message(falling).contains("scaled_distance_m_kg13 holds 1 in row 2 after 1"));
    let negative = CurveTable { impulse: Some(vec![1.0, 1.0, -3.0]), ..good.clone() };
    assert!(message(negative).contains("impulse_pa_s_kg13 holds -3 in row 3"));
    let ragged = CurveTable { duration: Some(vec![1.0]), ..good.clone() };
    assert!(message(ragged).contains("duration_s_kg13 has 1 rows, but must have 3"));
    let nan = CurveTable { overpressure: vec![9e5, f64::NAN, 5e4], ..good };
    assert!(message(nan).contains("overpressure_pa holds NaN in row 2"));
}

#[test]
fn samples_are_counted_a_decade() {
    let table = CurveTable {
        scaled_distance: (0..=20).map(|step| 10f64.powf(step as f64 / 10.0)).collect(),
        ..CurveTable::default()
    };
    assert!((table.samples_per_decade() - 10.0).abs() < 1e-9);
}
