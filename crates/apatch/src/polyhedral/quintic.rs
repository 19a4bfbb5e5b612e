use super::hull::Hull;
use super::report::FairnessReport;
use super::settings::FairnessSettings;
pub(crate) fn quintic(_h: &Hull, _s: &FairnessSettings) -> (Vec<f64>, FairnessReport) {
    todo!()
}
