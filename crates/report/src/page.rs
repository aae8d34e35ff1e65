//! The page that the sections make.

use super::Section;
use super::plan::Plan;

/// The page.
pub fn assemble(plan: &Plan, sections: &[Section]) -> String {
    let mut page = format!(
        "# Speed and accuracy\n\n\
         What photons, precision, offset and sampler do to the error of the stored photons, \
         measured by \
         `photon-mapping report{}` in the handout's scene. Errors are differences from the \
         expected hits \
         that `photon-mapping expect` computes without tracing. Every number follows from the CSV \
         files beside \
         this page.\n",
        plan.options
    );
    for section in sections {
        page += "\n";
        page += &section.markdown;
    }
    page
}
