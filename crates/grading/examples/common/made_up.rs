//! Points and pixels that somebody made up.

use std::f32::consts::TAU;

use glam::{DVec3, Vec2, Vec3};

use grading::judge_list::Expectations;
use grading::picture::view::{PIXELS, View};
use photon_list::reader::PhotonList;
use photon_list::record::{ABSENT, Columns};
use photon_mapping::assignment8::WIDTH;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::random::photon_random;

type Rand<'a> = &'a mut dyn FnMut() -> f32;
type Make<'a> = dyn Fn(usize, Rand) -> Vec<Vec3> + Sync + 'a;

/// A way to make up points.
pub struct Kind<'a> {
    /// What was done.
    pub name: &'static str,
    /// Makes so many.
    make: Box<Make<'a>>,
}

impl Kind<'_> {
    /// So many points.
    pub fn points(&self, count: usize, seed: u64) -> Vec<Vec3> {
        (self.make)(count, &mut photon_random(seed, count as u64))
    }
}

/// The list of `points`.
pub fn list(points: Vec<Vec3>) -> PhotonList {
    let record = |position| PhotonRecord { position, ..ABSENT };
    let records = points.into_iter().map(record).collect();
    PhotonList { columns: Columns::default(), records }
}

/// The kinds of points that people make up.
pub fn kinds<'a>(expectations: &'a Expectations) -> Vec<Kind<'a>> {
    let places = &expectations.places;
    let reference = &expectations.signatures.fair[0].signature;
    let facets = &places.facets;
    let on = |facet: usize, [u, v]: [f32; 2]| -> Vec3 {
        let [a, b, c, d]: [DVec3; 4] = facets[facet].corners;
        let (u, v) = (f64::from(u.clamp(0.0, 1.0)), f64::from(v.clamp(0.0, 1.0)));
        a.lerp(b, u).lerp(d.lerp(c, u), v).as_vec3()
    };
    let largest = |axis: DVec3| {
        let looks_there = |at: &usize| facets[*at].normal.dot(axis).abs() > 0.9;
        let size = |at: &usize| facets[*at].corners[0].distance(facets[*at].corners[2]);
        let there = (0..facets.len()).filter(looks_there);
        there.max_by(|a, b| size(a).total_cmp(&size(b))).expect("there is one")
    };
    let (floor, wall) = (largest(DVec3::Z), largest(DVec3::X));
    let of_facets = &reference.classes[..facets.len()];
    let all: f64 = of_facets.iter().sum();
    let facet_of_share = move |mut share: f64| {
        let at = of_facets.iter().position(|part| {
            share -= part / all;
            share < 0.0
        });
        at.unwrap_or(floor)
    };
    let kind = |name, one: Box<dyn Fn(f32, Rand) -> Vec3 + Sync + 'a>| Kind {
        name,
        make: Box::new(move |count, rand| {
            (0..count).map(|at| one(at as f32 / count as f32, rand)).collect()
        }),
    };
    let grid = |facet: usize| {
        move |count: usize, _: Rand| {
            let side = (count as f32).sqrt().ceil() as usize;
            let part = |at: usize| (at as f32 + 0.5) / side as f32;
            (0..count).map(|at| on(facet, [part(at % side), part(at / side)])).collect()
        }
    };
    let of_fair = move |count: usize, rand: Rand| {
        let spots: Vec<Vec3> =
            (0..10).map(|_| on(facet_of_share(f64::from(rand())), [rand(), rand()])).collect();
        let mut jitter = || 0.01 * (rand() - 0.5);
        let moved = |at: usize| spots[at % 10] + Vec3::new(jitter(), jitter(), jitter());
        (0..count).map(moved).collect()
    };
    let copies = move |count: usize, rand: Rand| {
        let spots: Vec<Vec3> = (0..10).map(|_| on(floor, [rand(), rand()])).collect();
        let mut jitter = || 0.04 * (rand() - 0.5);
        let moved = |at: usize| spots[at % 10] + Vec3::new(jitter(), jitter(), 0.0);
        (0..count).map(moved).collect()
    };
    vec![
        kind("on the floor", Box::new(move |_, rand| on(floor, [rand(), rand()]))),
        kind("on the wall", Box::new(move |_, rand| on(wall, [rand(), rand()]))),
        kind(
            "on two facets",
            Box::new(move |_, rand| {
                let facet = if rand() < 0.5 { floor } else { wall };
                on(facet, [rand(), rand()])
            }),
        ),
        kind("all facets", Box::new(move |_, rand| on((rand() * 12.0) as usize, [rand(), rand()]))),
        kind(
            "as many as fair",
            Box::new(move |_, rand| on(facet_of_share(f64::from(rand())), [rand(), rand()])),
        ),
        kind(
            "in the room",
            Box::new(|_, rand| Vec3::new(2.0 * rand() - 1.0, 2.0 * rand() - 1.0, 2.0 * rand())),
        ),
        kind(
            "cloud on floor",
            Box::new(move |_, rand| {
                let mut bell = || 0.25 * (rand() + rand() + rand() + rand() - 2.0);
                on(floor, [0.35 + bell(), 0.3 + bell()])
            }),
        ),
        kind(
            "cloud on wall",
            Box::new(move |_, rand| {
                let mut bell = || 0.4 * (rand() + rand() + rand() + rand() - 2.0);
                on(wall, [0.5 + bell(), 0.5 + bell()])
            }),
        ),
        kind("line", Box::new(move |part, _| on(floor, [0.1 + 0.8 * part, 0.9 * part]))),
        kind("line on wall", Box::new(move |part, _| on(wall, [0.1 + 0.8 * part, 0.9 * part]))),
        kind(
            "ring",
            Box::new(move |part, _| {
                let way = 0.4 * Vec2::from_angle(TAU * part);
                on(floor, [0.5 + way.x, 0.5 + way.y])
            }),
        ),
        Kind { name: "grid on floor", make: Box::new(grid(floor)) },
        Kind { name: "grid on wall", make: Box::new(grid(wall)) },
        Kind { name: "ten spots", make: Box::new(of_fair) },
        Kind { name: "ten on the floor, moved", make: Box::new(copies) },
    ]
}

/// A patch of noise of `side` pixels around one of `view`, with `count` red ones.
pub fn patch_of_noise(view: &View, side: usize, count: usize, seed: u64) -> Vec<bool> {
    let mut rand = photon_random(seed, count as u64);
    let mut any = |below: usize| (rand() * below as f32) as usize;
    let mut red = vec![false; PIXELS];
    let width = WIDTH as usize;
    let middle = loop {
        let pixel = any(PIXELS);
        if view.patch(pixel).is_some() {
            break pixel;
        }
    };
    let middle = if side < width { middle } else { (PIXELS + width) / 2 };
    let (row, column) = (middle / width, middle % width);
    for _ in 0..count {
        let (row, column) = (row + any(side), column + any(side));
        let is_inside = row >= side / 2 && (side / 2..width + side / 2).contains(&column);
        let pixel = (row * width + column).wrapping_sub(side / 2 * (width + 1));
        if is_inside && pixel < PIXELS && view.shows_surface(pixel) {
            red[pixel] = true;
        }
    }
    red
}
