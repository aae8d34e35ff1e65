//! Our side of `peers/run.sh`, which calls this program in turn with the peers.

use std::io::Read;
use std::ops::ControlFlow;
use std::time::Instant;

use fast::trace::trace_list;
use fast::tree::accelerate;
use glam::Vec3;
use photon_mapping::assignment8;
use photon_mapping::scene::Scene;
use photon_mapping::scene::ray::IntersectionState;
use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::triangle::Triangle;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["photons", count, threads, ..] => photons(
            count.parse().expect("a number of photons"),
            threads.parse().expect("a number of threads"),
        ),
        ["mesh", path, ..] => mesh(path),
        // Called by `cargo bench` or `cargo test` with nothing to compare with.
        _ => {}
    }
}

/// Seconds of processor time that this thread has taken. Other programs on the machine lengthen it
/// far less than the time of the clock.
fn processor_seconds() -> f64 {
    let statistics = std::fs::read_to_string("/proc/thread-self/schedstat").expect("Linux");
    let nanoseconds = statistics.split(' ').next().and_then(|word| word.parse().ok());
    1e-9 * nanoseconds.unwrap_or(f64::NAN)
}

/// Prints nanoseconds a photon and how many are stored. The nanoseconds are processor time for one
/// thread, and by the clock for more.
fn photons(count: u64, threads: usize) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let mut renderer = assignment8::create_renderer(assignment8::create_scene());
    renderer.photon_count = count;
    pool.install(|| {
        let start = (Instant::now(), processor_seconds());
        let mut stored = 0;
        let ended = trace_list(&renderer, 0..renderer.emitted(), |records, _| {
            stored += records.len();
            Ok::<(), ControlFlow<()>>(())
        });
        assert!(ended.is_ok());
        let by_the_clock = start.0.elapsed().as_secs_f64();
        let seconds = if threads == 1 { processor_seconds() - start.1 } else { by_the_clock };
        println!("{} {stored}", seconds / count as f64 * 1e9);
    });
}

/// Traces the rays of the file `path` into its mesh. Prints seconds of processor time for the
/// build, nanoseconds of it a ray, and how many rays hit.
///
/// The file has the number of triangles and of rays as u64. Then come f32: three corners a
/// triangle, origins, directions.
fn mesh(path: &str) {
    let mut bytes = Vec::new();
    let mut file = std::fs::File::open(path).expect("the mesh");
    file.read_to_end(&mut bytes).expect("the mesh");
    let count = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().expect("8 bytes"));
    let (triangles, rays) = (count(0) as usize, count(8) as usize);
    let float = |bytes: &[u8]| f32::from_le_bytes(bytes.try_into().expect("4 bytes"));
    let floats: Vec<f32> = bytes[16..].chunks_exact(4).map(float).collect();
    let points: Vec<Vec3> = floats.chunks_exact(3).map(Vec3::from_slice).collect();
    let (corners, ends) = points.split_at(3 * triangles);
    let (origins, directions) = ends.split_at(rays);
    let triangles: Vec<Triangle> = corners
        .chunks_exact(3)
        .map(|c| {
            let normal = (c[1] - c[0]).cross(c[2] - c[0]).normalize_or(Vec3::Z);
            // The mesh is a bumpy sphere about the origin.
            let normal = normal * normal.dot(c[0]).signum();
            let vertices = [c[0], c[1], c[2]];
            Triangle { vertices, normal, parent_mesh_object: 0, facet: 0 }
        })
        .collect();
    let rays: Vec<Ray> = origins.iter().zip(directions).map(|(o, d)| Ray::new(*o, *d)).collect();
    let start = processor_seconds();
    let mut scene = Scene::new(Vec::new(), triangles, Vec::new());
    accelerate(&mut scene);
    let build = processor_seconds() - start;
    let start = processor_seconds();
    let mut state = IntersectionState::new();
    let found = rays.iter().filter(|ray| scene.trace(ray, Some(&mut state))).count();
    println!("{build} {} {found}", (processor_seconds() - start) / rays.len() as f64 * 1e9);
}
