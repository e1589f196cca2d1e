//! Raw mixing depends on the unit of length, row-normalised mixing does not.

use qparam_cli::qembed::Mixing;
use qparam_cli::qoptimize::Options;
use qparam_cli::qsimplify::RemovalRule;

use super::inputs::{errors, models, paper, run};
use super::table::Table;

pub(super) fn section() -> Result<String, String> {
    let mut table = Table::new("mesh | mixing | unit | E13 | E14 | flips");
    for (name, mesh) in models() {
        for (mixing_name, mixing) in [("raw", Mixing::Raw), ("row-normalised", Mixing::RowNormalized)] {
            for unit in [1e-3, 1.0, 1e3] {
                let scaled = mesh.clone().with_positions(mesh.vertex_data(|v| mesh.position(v) * unit));
                let options = Options { mixing, ..paper(RemovalRule::All, 1.0) };
                let mut row = vec![name.to_owned(), mixing_name.to_owned(), format!("× {unit}")];
                row.extend(errors(&run(&scaled, &options)?.distortion));
                table.row(&row);
            }
        }
    }
    Ok(format!("Rule `all`, the same mesh in three units of length.\n\n{}", table.text()))
}
