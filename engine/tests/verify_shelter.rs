//! quick
use brisance_engine::occlusion::*;
use glam::*;

fn block(centre: DVec3, size: DVec3, turn: DQuat, group: u32) -> Solid {
    let rot = DMat3::from_quat(turn);
    let half = size * 0.5;
    Solid { form: Form::Box { centre, half, world_from_box: rot }, group, occludes: true, points: vec![] }
}

#[test]
fn quick() {
    let a = block(dvec3(0., 0., 5.), dvec3(2., 2., 0.2), DQuat::IDENTITY, 0);
    let b = block(dvec3(0., 0., 7.), dvec3(0.5, 0.5, 0.5), DQuat::IDENTITY, 1);
    for res in [16, 32, 64, 128, 256] {
        let s = shelter(&[a.clone(), b.clone()], DVec3::ZERO, None, &Settings { resolution: res, ..Default::default() }).unwrap();
        println!("{res} {:?} {}", s.bodies[1], s.enclosed);
    }
    let _ = std::hint::black_box(0);
    let side = 100;
    let mut yard = vec![];
    for i in 0..side * side {
        let p = dvec3((i % side) as f64 - 50.0, 0.08 + 0.3 * ((i * 7919) % 13) as f64 / 13.0, (i / side) as f64 + 2.0) * 2.0;
        yard.push(block(p, dvec3(0.6, 0.5, 0.4), DQuat::from_rotation_y(i as f64), i as u32));
    }
    for _ in 0..3 {
        let t = std::time::Instant::now();
        let s = shelter(&yard, dvec3(0., 1., 0.), None, &Settings::default()).unwrap();
        let hidden = s.bodies.iter().filter(|b| b.attenuation < 1.0).count();
        println!("{:?} {hidden} {}", t.elapsed(), s.enclosed);
    }
}
