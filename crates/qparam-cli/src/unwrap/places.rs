//! Where the outputs of a run go.

use std::path::PathBuf;

use crate::args::UnwrapArgs;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::layout_args::SeamSource;
use crate::output::Target;

/// `IN_uv.obj` beside the input, unless the caller says otherwise.
pub(super) fn output_path(arguments: &UnwrapArgs) -> PathBuf {
    let input = &arguments.input;
    match &arguments.output {
        Some(path) => path.clone(),
        None if input.as_os_str() == "-" => input.clone(),
        None => {
            let mut name = input.file_stem().unwrap_or_default().to_owned();
            name.push("_uv");
            if let Some(extension) = input.extension() {
                name.push(".");
                name.push(extension);
            }
            input.with_file_name(name)
        }
    }
}

/// Two outputs, or two inputs, in one place.
pub(super) fn refuse_clashes(
    arguments: &UnwrapArgs,
    target: &Target,
    simplified: Option<&Target>,
    page: Option<&Target>,
) -> Result<(), Failure> {
    let refuse = |what: &str, help: &str| Err(Failure::new(Exit::Usage, what).help(help));
    let dash = |path: Option<&PathBuf>| path.is_some_and(|path| path.as_os_str() == "-");
    if simplified.is_some_and(|simplified| simplified.is_same_place(target)) {
        return refuse(
            "the UVs and the simplified mesh would go to the same place",
            "name two different files with -o and --simplified",
        );
    }
    let input = Target::new(&arguments.input);
    if let Some(page) = page
        && [Some(target), simplified, Some(&input)]
            .into_iter()
            .flatten()
            .any(|other| page.is_same_place(other))
    {
        return refuse(
            "the page would go to the same place as a mesh",
            "name another file with --report, one that ends in .html",
        );
    }
    if page == Some(&Target::Stdout) {
        return refuse("the page would be mixed with the report", "name a file with --report");
    }
    let is_file = |target: &Target| matches!(target, Target::File(_));
    if simplified.is_some_and(|simplified| is_file(simplified) && simplified.is_same_place(&input)) {
        return refuse(
            "the simplified mesh would replace the input",
            "name another file with --simplified: what was removed cannot be brought back",
        );
    }
    let inputs = [Some(&arguments.input), arguments.map.boundary_uv.as_ref(), arguments.pins.as_ref()];
    let seams = arguments.layout.seams.iter().map(SeamSource::file);
    if inputs.into_iter().chain(seams).filter(|&path| dash(path)).count() > 1 {
        return refuse(
            "standard input cannot be read twice",
            "name a file for the mesh, for --boundary-uv, for --pins and for --seams",
        );
    }
    if arguments.json && simplified == Some(&Target::Stdout) {
        return refuse(
            "the simplified mesh and the JSON report would both go to standard output",
            "name a file with --simplified",
        );
    }
    Ok(())
}
