//! Models, and behind the first zero byte their material library.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    let mut parts = data.splitn(2, |byte| *byte == 0);
    let mut text = || String::from_utf8_lossy(parts.next().unwrap_or_default()).into_owned();
    let (model, materials) = (text(), text());
    if let Ok(model) = model::obj::parse(&model, |_| Ok(materials.clone())) {
        assert!(!model.triangles.is_empty());
        for triangle in &model.triangles {
            assert!(triangle.vertices.iter().all(|corner| corner.is_finite()));
            assert!(triangle.normal.is_normalized());
            assert!(triangle.parent_mesh_object < model.mesh_objects.len());
        }
    }
});
