//! Lists in the model's axes, where y is up.

use glam::Vec3;

use super::places::{Place, Places};
use crate::limits::NEARLY_ALL;
use crate::limits::axes::{HARDLY_ALL, PROBES};
use photon_list::reader::PhotonList;

/// Turns `list` to world space if it is plainly in the model's axes, and tells whether it was.
pub fn turn_to_world(list: &mut PhotonList, places: &Places) -> bool {
    let step = list.records.len() / PROBES + 1;
    let part_on_surfaces = |turn: fn(Vec3) -> Vec3| {
        let probes = list.records.iter().step_by(step).map(|record| turn(record.position));
        let finite: Vec<Vec3> = probes.filter(|position| position.is_finite()).collect();
        let is_on_a_surface =
            |position: &&Vec3| places.place(position.as_dvec3()) != Place::OffSurface;
        finite.iter().filter(is_on_a_surface).count() as f64 / finite.len().max(1) as f64
    };
    let is_turned = part_on_surfaces(|position| position) < HARDLY_ALL
        && part_on_surfaces(to_world) > NEARLY_ALL;
    if is_turned {
        for record in &mut list.records {
            record.position = to_world(record.position);
            record.to_light = to_world(record.to_light);
        }
    }
    is_turned
}

/// World (x, y, z) is (x, z, -y) in the model.
fn to_world(of_model: Vec3) -> Vec3 {
    Vec3::new(of_model.x, -of_model.z, of_model.y)
}
