//! The page that the sections make.

use super::PageSection;
use super::plan::Plan;

/// The page.
pub fn assemble(plan: &Plan, sections: &[PageSection]) -> String {
    let mut page = format!(
        "# Speed and accuracy\n\n\
         This page measures what the number of photons, precision, offset and sampler do to the \
         error of the stored photons. It comes from `photon-mapping report{}` in the handout's \
         scene. Errors are differences from the expected values that `photon-mapping expect` \
         computes without tracing. Every number follows from the CSV files beside this page.\n",
        plan.options
    );
    for section in sections {
        page += "\n";
        page += &section.markdown;
    }
    page
}
