//! Solids as the tests and benchmarks of shelter use them.
#![allow(dead_code)] // each test program uses its own part

use brisance_engine::loading::box_panels;
use brisance_engine::occlusion::{Form, Settings, Shelter, Solid, SurfacePoint, shelter};
use glam::{DMat3, DQuat, DVec3};

/// A box of its own group.
pub fn block(centre: DVec3, size: DVec3, turn: DQuat, group: u32) -> Solid {
    let points = box_panels(size, [false; 6])
        .iter()
        .map(|panel| SurfacePoint {
            position: centre + turn * panel.centre,
            area: turn * panel.normal * panel.area,
        })
        .collect();
    let form = Form::Box { centre, half: size * 0.5, world_from_box: DMat3::from_quat(turn) };
    Solid { form, group, occludes: true, points, by_point: false }
}

/// The same solids, turned together about the origin.
pub fn turned(solids: &[Solid], turn: DQuat) -> Vec<Solid> {
    let matrix = DMat3::from_quat(turn);
    solids
        .iter()
        .map(|solid| {
            let Form::Box { centre, half, world_from_box } = solid.form else { panic!("only boxes") };
            Solid {
                form: Form::Box { centre: turn * centre, half, world_from_box: matrix * world_from_box },
                group: solid.group,
                occludes: solid.occludes,
                by_point: solid.by_point,
                points: solid
                    .points
                    .iter()
                    .map(|p| SurfacePoint { position: turn * p.position, area: turn * p.area })
                    .collect(),
            }
        })
        .collect()
}

/// Shelter from a charge at the origin.
pub fn shelters(solids: &[Solid], resolution: usize) -> Vec<Shelter> {
    let settings = Settings { resolution, ..Settings::default() };
    shelter(solids, DVec3::ZERO, None, &settings).unwrap().bodies
}

/// A yard of crates, `count` in all, two metres apart around a charge at the origin, none above another.
pub fn yard(count: usize) -> Vec<Solid> {
    let side = (count as f64).sqrt().ceil() as usize;
    (0..count)
        .map(|i| {
            let (column, row) = ((i % side) as f64, (i / side) as f64);
            let scatter = 0.2 * ((i * 7919 % 13) as f64 / 13.0 - 0.5);
            let middle = 0.5 * side as f64;
            let place = DVec3::new(column - middle + 0.5 + scatter, -0.4, row - middle + 0.5 - scatter) * 2.0;
            block(place, DVec3::new(0.7, 0.8, 0.6), DQuat::from_rotation_y(i as f64), i as u32)
        })
        .collect()
}
