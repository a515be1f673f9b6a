//! A charge of TNT computed from its detonation on, beside the curves fitted to experiments.

mod hydro;

use brisance_engine::air::{Air, Shock};
use brisance_engine::blast::curves::Curves;
use brisance_engine::charge::{Burst, CurveSource};
use brisance_engine::detonation::Explosive;
use brisance_engine::hydrocode::blast::{ChargeRun, Start};
use brisance_engine::hydrocode::{Gauge, Scheme, Symmetry, ViscositySettings, whole};
use hydro::relative;

fn gauges(run: &ChargeRun, distances: &[f64]) -> Vec<Gauge> {
    run.record(&mut run.godunov().unwrap(), distances, 0.0, |_| Ok(())).unwrap()
}

fn coarse() -> ChargeRun {
    ChargeRun { product_cells: 100, air_cells: 200, ..ChargeRun::default() }
}

#[test]
fn the_charge_holds_its_mass_and_energy() {
    for (symmetry, dimension) in [(Symmetry::Plane, 0), (Symmetry::Cylindrical, 1), (Symmetry::Spherical, 2)]
    {
        let run = ChargeRun { symmetry, mass: 3.0, ..coarse() };
        let flow = run.godunov().unwrap();
        let (mass, _, energy) = flow.totals();
        let both = if symmetry == Symmetry::Plane { 2.0 } else { 1.0 };
        let factor = both * whole(symmetry);
        // The first layer of shocked air adds some parts in ten thousand.
        assert!(relative(factor * mass, 3.0) < 1e-3, "{symmetry:?} {dimension} {}", factor * mass);
        assert!(relative(factor * energy, 3.0 * Explosive::TNT.energy) < 2e-3);
    }
    // 1 kg of cast TNT is a sphere of 52.7 mm radius.
    assert!(relative(coarse().radius(), 0.0527) < 1e-3);
}

#[test]
fn the_mesh_gathers_exactly_the_air_that_the_front_sweeps() {
    let run = coarse();
    let mut flow = run.godunov().unwrap();
    let edge = |flow: &dyn Fn() -> f64| flow().powi(3) / 3.0;
    let last = flow.face().len() - 1;
    let (mass, _, energy) = flow.totals();
    let before = edge(&|| flow.face()[last]);
    flow.run(2e-4, |_| Ok(())).unwrap();
    let (mass_after, _, energy_after) = flow.totals();
    let swept = edge(&|| flow.face()[last]) - before;
    let air = Air::SEA_LEVEL;
    // Summed over some ten thousand steps.
    assert!(relative(mass_after, mass + swept * air.density()) < 1e-11);
    assert!(relative(energy_after, energy + swept * air.pressure / 0.4) < 1e-11);
}

#[test]
fn the_front_obeys_rankine_and_hugoniot() {
    let run = coarse();
    for gauge in gauges(&run, &[0.1, 0.5, 2.0]) {
        let shock = Shock::behind(&Air::SEA_LEVEL, gauge.overpressure);
        assert!(relative(gauge.front_velocity.unwrap(), shock.front_velocity) < 1e-9);
        assert!(relative(gauge.dynamic_pressure, shock.dynamic_pressure) < 1e-9);
    }
}

#[test]
fn from_z_1_to_10_it_agrees_with_kingery_and_bulmash_as_far_as_stated() {
    // 5 % of arrival throughout. Pressure within 10 % but around Z = 2, where it is 12 % low: the products of
    // TNT burn on in the air and feed a real wave there, which is left out (docs/theory.md).
    let curves = Curves::new(&CurveSource::KingeryBulmash, Burst::Air).unwrap();
    let distances = [1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    for gauge in gauges(&coarse(), &distances) {
        let z = gauge.distance;
        let measured = curves.at(z);
        let arrival = gauge.arrival.unwrap() / curves.arrival_time(z).unwrap();
        let pressure = gauge.overpressure / measured.overpressure;
        assert!((arrival - 1.0).abs() < 0.05, "Z {z}: arrival {arrival}");
        let low = if (1.4..3.5).contains(&z) { 0.13 } else { 0.10 };
        assert!(pressure > 1.0 - low && pressure < 1.10, "Z {z}: pressure {pressure}");
        let impulse = gauge.impulse / measured.impulse;
        assert!((0.65..1.0).contains(&impulse), "Z {z}: impulse {impulse}");
        assert!(gauge.duration.unwrap() < measured.duration);
    }
}

#[test]
fn a_tenth_more_energy_would_bring_every_pressure_within_ten_percent() {
    // What burns late is missing; a charge larger by a tenth stands for it. No other quantity is fitted.
    let curves = Curves::new(&CurveSource::KingeryBulmash, Burst::Air).unwrap();
    let distances = [1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    let run = ChargeRun { mass: 1.1, ..coarse() };
    for gauge in gauges(&run, &distances) {
        let pressure = gauge.overpressure / curves.at(gauge.distance).overpressure;
        assert!((pressure - 1.0).abs() < 0.10, "Z {}: {pressure}", gauge.distance);
        let arrival = gauge.arrival.unwrap() / curves.arrival_time(gauge.distance).unwrap();
        assert!((arrival - 1.0).abs() < 0.05, "Z {}: {arrival}", gauge.distance);
    }
}

/// Rows of the stored table: Z and the six columns after it.
fn stored() -> Vec<Vec<f64>> {
    let text = include_str!("../data/hydrocode_curves.csv");
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    rows.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
}

#[test]
fn the_stored_table_is_what_its_settings_give() {
    // The rows up to Z = 0.4, with the settings that the file's first lines name; seven digits are stored.
    let run = ChargeRun { product_cells: 400, air_cells: 600, courant: 0.8, ..ChargeRun::default() };
    assert!(include_str!("../data/hydrocode_curves.csv").contains("400 in the products, 600 in the air"));
    let rows: Vec<_> = stored().into_iter().filter(|row| row[0] < 0.4).collect();
    let distances: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    for (row, gauge) in rows.iter().zip(gauges(&run, &distances)) {
        let computed = [
            gauge.overpressure,
            gauge.dynamic_pressure,
            gauge.front_velocity.unwrap(),
            gauge.duration.unwrap(),
            gauge.impulse,
            gauge.arrival.unwrap(),
        ];
        for (stored, computed) in row[1..].iter().zip(computed) {
            assert!(relative(computed, *stored) < 1e-6, "Z {}: {computed} {stored}", row[0]);
        }
    }
    let coarse = gauges(&coarse(), &[1.0, 10.0]);
    for gauge in coarse {
        let row = stored()
            .into_iter()
            .min_by(|a, b| (a[0] - gauge.distance).abs().total_cmp(&(b[0] - gauge.distance).abs()));
        // The nearest row lies up to 4 % away, over which the pressure falls by up to 10 %.
        assert!(relative(row.unwrap()[1], gauge.overpressure) < 0.12);
    }
}

#[test]
fn the_curve_source_reads_the_stored_table() {
    let curves = Curves::new(&CurveSource::Hydrocode, Burst::Air).unwrap();
    for row in stored() {
        let point = curves.at(row[0]);
        assert!(relative(point.overpressure, row[1]) < 1e-12);
        assert!(relative(point.impulse, row[5]) < 1e-12);
        assert!(relative(curves.arrival_time(row[0]).unwrap(), row[6]) < 1e-12);
    }
    assert_eq!(curves.range(), (0.06, 40.0));
    assert_eq!(Curves::new(&CurveSource::Hydrocode, Burst::Surface).unwrap().energy_factor(), 1.8);
}

#[test]
fn finer_meshes_agree() {
    // The front's own quantities between 300 and 600 cells: the scheme's error is a quarter of it.
    let fine = ChargeRun { product_cells: 200, air_cells: 400, ..ChargeRun::default() };
    let distances = [0.3, 1.0, 3.0];
    for (one, other) in gauges(&coarse(), &distances).iter().zip(gauges(&fine, &distances)) {
        assert!(relative(one.overpressure, other.overpressure) < 0.02, "{}", one.distance);
        assert!(relative(one.arrival.unwrap(), other.arrival.unwrap()) < 5e-3);
        assert!(relative(one.impulse, other.impulse) < 0.01);
    }
}

#[test]
fn both_schemes_tell_the_same_story() {
    // The viscosity spreads the shock over four cells, here 5 % of the way, and so cuts its peak and lets it
    // come early by half of that; the impulse does not depend on it.
    let run = ChargeRun { product_cells: 60, air_cells: 400, ..ChargeRun::default() };
    let mut flow = run.viscosity(3.0, ViscositySettings::default()).unwrap();
    let spread = run.record(&mut flow, &[0.5, 1.0], 0.0, |_| Ok(())).unwrap();
    for (one, other) in spread.iter().zip(gauges(&run, &[0.5, 1.0])) {
        let (arrival, impulse) = (one.arrival.unwrap() / other.arrival.unwrap(), one.impulse / other.impulse);
        assert!((arrival - 1.0).abs() < 0.04, "{}: arrival {arrival}", one.distance);
        assert!((impulse - 1.0).abs() < 0.04, "{}: impulse {impulse}", one.distance);
        assert!(one.overpressure < 1.05 * other.overpressure && one.overpressure > 0.75 * other.overpressure);
    }
}

#[test]
fn charges_of_any_size_make_the_same_wave_at_the_same_scaled_distance() {
    let one = &gauges(&coarse(), &[1.0])[0];
    let large = &gauges(&ChargeRun { mass: 1000.0, ..coarse() }, &[10.0])[0];
    // The same flow in other units: equal but for rounding, and for where the steps happen to fall.
    assert!(relative(large.overpressure, one.overpressure) < 1e-6);
    assert!(relative(large.arrival.unwrap(), 10.0 * one.arrival.unwrap()) < 1e-6);
    assert!(relative(large.impulse, 10.0 * one.impulse) < 1e-6);
}

#[test]
fn thin_air_obeys_sachs() {
    // Half the pressure: the same wave, in pressure over p0, at distances longer by the cube root of two.
    let thin = Air { pressure: 0.5 * Air::SEA_LEVEL.pressure, ..Air::SEA_LEVEL };
    let one = &gauges(&coarse(), &[5.0])[0];
    let other = &gauges(&ChargeRun { air: thin, ..coarse() }, &[5.0 * 2.0_f64.cbrt()])[0];
    // Sachs's law holds where the air swept outweighs the charge; at Z = 5 it does some five hundred times.
    assert!(relative(other.overpressure, 0.5 * one.overpressure) < 0.01);
    assert!(relative(other.arrival.unwrap(), 2.0_f64.cbrt() * one.arrival.unwrap()) < 0.02);
}

#[test]
fn a_run_gives_the_same_bits_every_time() {
    let one = gauges(&coarse(), &[0.5, 1.0]);
    let other = gauges(&coarse(), &[0.5, 1.0]);
    assert_eq!(one, other);
}

#[test]
fn what_cannot_be_is_refused_in_one_sentence() {
    let refused = |run: ChargeRun| run.godunov().map(|_| ()).unwrap_err().to_string();
    assert!(refused(ChargeRun { mass: -1.0, ..coarse() }).contains("charge mass [kg] is -1"));
    assert!(refused(ChargeRun { air_cells: 3, ..coarse() }).contains("10 or more"));
    assert!(refused(ChargeRun { courant: 2.0, ..coarse() }).contains("Courant number is 2"));
    let mut flow = coarse().godunov().unwrap();
    let said = coarse().record(&mut flow, &[0.01], 0.0, |_| Ok(())).unwrap_err().to_string();
    assert!(said.contains("distance of a gauge [m] is 0.01"), "{said}");
    assert!(coarse().viscosity(0.06, ViscositySettings::default()).is_err());
    let still = ChargeRun { start: Start::ConstantVolume, ..coarse() };
    assert!(still.godunov().is_ok());
}
