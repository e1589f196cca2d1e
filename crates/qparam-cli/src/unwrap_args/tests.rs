//! What is typed is what the library gets, and the defaults are the same everywhere.

use clap::{CommandFactory, Parser, ValueEnum};
use qoptimize::Preset;

use super::{Options, PresetChoice, UnwrapArgs};

#[derive(Parser)]
struct Alone {
    #[command(flatten)]
    unwrap: UnwrapArgs,
}

fn options(arguments: &[&str]) -> Options {
    let alone = Alone::try_parse_from([&["unwrap", "in.obj"], arguments].concat()).unwrap();
    alone.unwrap.options().unwrap()
}

/// The help shows the library's defaults: saying nothing means the same here and there.
#[test]
fn the_defaults_are_those_of_the_library() {
    assert_eq!(options(&[]), Options::default());
}

/// The README's table of options names the same defaults, in brackets after the option.
#[test]
fn the_defaults_are_those_of_the_readme() {
    let readme = include_str!("../../../../README.md");
    let (_, table) = readme.split_once("### Options of `unwrap`").unwrap();
    let (table, _) = table.split_once("`qparam unwrap --help`").unwrap();
    let command = Alone::command();
    let mut checked = 0;
    // Between backticks at odd places stands code, at the next even one what follows it.
    let pieces: Vec<&str> = table.split('`').collect();
    for pair in pieces[1..].chunks_exact(2) {
        let Some(option) = pair[0].strip_prefix("--") else { continue };
        let name = option.split([' ', '\\']).next().unwrap();
        let known = command.get_arguments().find(|argument| argument.get_long() == Some(name));
        let known = known.unwrap_or_else(|| panic!("--{name} is no option"));
        let Some(said) = pair[1].strip_prefix(" (") else { continue };
        let said = said.split([' ', ')', ':']).next().unwrap();
        let default = known.get_default_values().first().map(|value| value.to_str().unwrap());
        assert!(said == default.unwrap_or("none") || said == "repeatable", "--{name} ({said}): {default:?}");
        checked += 1;
    }
    assert!(checked > 20, "{checked} defaults");
}

/// What `--preset` expands to is what the library's preset is.
#[test]
fn presets_are_those_of_the_library() {
    for choice in PresetChoice::value_variants() {
        let typed = choice.arguments().map(|(name, value)| format!("--{name}={value}"));
        let typed: Vec<&str> = typed.iter().map(String::as_str).collect();
        assert_eq!(options(&typed), Preset::from(*choice).options(), "{choice:?}");
    }
}

/// Every option changes exactly the library option it names.
#[test]
fn every_choice_arrives() {
    let changes = [
        "--method=lscm",
        "--method=paper",
        "--q=0.25",
        "--boundary=square",
        "--boundary=circle",
        "--no-normalize",
        "--symmetric",
        "--rule=ring",
        "--remove-fraction=0.1",
        "--remove-below=0.1",
        "--curvature=integrated",
        "--area=face-sum",
        "--side=high",
        "--exponent=2",
        "--weights=star1",
        "--mixing=raw",
        "--no-overlap-removal",
        "--lambda1=0.1",
        "--lambda2=0.1",
        "--order=first-come",
        "--max-moves=1",
        "--shape=2",
        "--angle-term=paper",
        "--max-steps=3",
        "--relative-decrease=1e-3",
        "--backend=direct",
        "--residual-bound=1e-3",
        "--max-iterations=9",
        "--uv-precision=f32",
    ];
    let results: Vec<_> = changes.iter().map(|change| options(&[change])).collect();
    for (i, result) in results.iter().enumerate() {
        assert_ne!(*result, Options::default(), "{} does nothing", changes[i]);
        for (j, other) in results.iter().enumerate().skip(i + 1) {
            assert_ne!(result, other, "{} and {} do the same", changes[i], changes[j]);
        }
    }
}
