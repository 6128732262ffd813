//! tmp
/// tmp
pub fn bibtex(_: &quasirigid_io::model::Model) -> String {
    String::new()
}
