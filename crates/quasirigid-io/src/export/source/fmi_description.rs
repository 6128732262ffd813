//! `modelDescription.xml`: variables of the body with their numbers, which `templates/fmi-unit.h` has too.

use std::fmt::{self, Write};

use super::fmu::Fmi;
use super::horner::number;
use super::{FreeBody, plain};

/// How the source of FMI 3.0 is compiled.
pub(super) const BUILD: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiBuildDescription fmiVersion="3.0">
  <BuildConfiguration modelIdentifier="{{name}}">
    <SourceFileSet language="C99">
      <SourceFile name="{{name}}.c"/>
      <SourceFile name="fmi-3.c"/>
    </SourceFileSet>
  </BuildConfiguration>
</fmiBuildDescription>
"#;

/// Number of states: angular momentum, quaternion, position, velocity.
const STATES: usize = 13;
/// First output that is no state.
const OUTPUTS: usize = 2 * STATES + 6;
/// Number of the Boolean that says whether the state is within the range, and that of the time.
const VALID: usize = OUTPUTS + 7;
const TIME: usize = OUTPUTS + 8;

/// Units, with their exponents of kg, m, s, rad.
const UNITS: [(&str, &str); 9] = [
    ("N.m.s", r#"kg="1" m="2" s="-1""#),
    ("N.m", r#"kg="1" m="2" s="-2""#),
    ("N", r#"kg="1" m="1" s="-2""#),
    ("rad/s", r#"s="-1" rad="1""#),
    ("rad", r#"rad="1""#),
    ("J", r#"kg="1" m="2" s="-2""#),
    ("W", r#"kg="1" m="2" s="-3""#),
    ("m", r#"m="1""#),
    ("m/s", r#"m="1" s="-1""#),
];

/// A real variable.
struct Variable {
    name: String,
    causality: &'static str,
    unit: Option<&'static str>,
    start: Option<f64>,
    /// Number of the state whose rate it is.
    rate_of: Option<usize>,
    meaning: &'static str,
}

/// The real variables in the order of their numbers.
fn variables(body: &FreeBody) -> Vec<Variable> {
    let (momentum, attitude) = body.start;
    let [position, velocity] = body.place;
    let starts = [momentum.as_slice(), &attitude, &position, &velocity].concat();
    let vector = |name: &str| ["x", "y", "z"].map(|axis| format!("{name}_{axis}")).to_vec();
    let groups = [
        (vector("K"), Some("N.m.s"), "angular momentum about the centre of mass, body axes"),
        (
            ["w", "x", "y", "z"].map(|part| format!("q_{part}")).to_vec(),
            None,
            "quaternion from body axes to inertial ones",
        ),
        (vector("position"), Some("m"), "position of the centre of mass, inertial axes"),
        (vector("velocity"), Some("m/s"), "velocity of the centre of mass, inertial axes"),
    ];
    let states = groups
        .into_iter()
        .flat_map(|(names, unit, meaning)| names.into_iter().map(move |name| (name, unit, meaning)));
    let states: Vec<_> = states
        .zip(starts)
        .map(|((name, unit, meaning), start)| Variable {
            name,
            causality: "output",
            unit,
            start: Some(start),
            rate_of: None,
            meaning,
        })
        .collect();
    let rate = |(state, of): (usize, &Variable)| Variable {
        name: format!("der({})", of.name),
        causality: "local",
        unit: None,
        start: None,
        rate_of: Some(state),
        meaning: "rate",
    };
    let rates: Vec<_> = states.iter().enumerate().map(rate).collect();
    let input = |name: &str, unit, meaning| {
        vector(name).into_iter().map(move |name| Variable {
            name,
            causality: "input",
            unit: Some(unit),
            start: Some(0.0),
            rate_of: None,
            meaning,
        })
    };
    let output = |(name, unit, meaning): (String, &'static str, &'static str)| Variable {
        name,
        causality: "output",
        unit: Some(unit),
        start: None,
        rate_of: None,
        meaning,
    };
    let spin =
        vector("omega").into_iter().map(|name| (name, "rad/s", "angular velocity of the carrier, body axes"));
    let scalars = [
        ("momentum", "N.m.s", "size of the angular momentum"),
        ("energy", "J", "energy of the rotation"),
        ("power", "W", "power dissipated"),
        ("nutation", "rad", "angle between the angular momentum and the axis that it circled at the start"),
    ];
    let scalars = scalars.map(|(name, unit, meaning)| (name.to_owned(), unit, meaning));
    states
        .into_iter()
        .chain(rates)
        .chain(input("torque", "N.m", "torque on the carrier, body axes"))
        .chain(input("force", "N", "force at the centre of mass, body axes"))
        .chain(spin.chain(scalars).map(output))
        .collect()
}

/// The description of a body.
pub(super) fn described(body: &FreeBody, version: Fmi, token: &str) -> String {
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let wrote = match version {
        Fmi::Two => write_two(&mut out, body, token),
        Fmi::Three => write_three(&mut out, body, token),
    };
    wrote.expect("a string takes any text");
    out
}

/// Text of an attribute.
fn attribute(text: &str) -> String {
    plain(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// The heading of the source, as one attribute.
fn description(body: &FreeBody) -> String {
    attribute(&body.heading().join(" "))
}

/// Outputs, rates of the states, and what is computed at the start, by their numbers.
fn unknowns(variables: &[Variable]) -> [Vec<usize>; 3] {
    let of = |wanted: fn(&Variable) -> bool| {
        variables.iter().enumerate().filter(move |(_, each)| wanted(each)).map(|(i, _)| i)
    };
    [
        of(|variable| variable.causality == "output").chain([VALID]).collect(),
        of(|variable| variable.rate_of.is_some()).collect(),
        of(|variable| variable.start.is_none()).chain([VALID]).collect(),
    ]
}

/// Attributes that both versions have: those of the variable, and those of its value, with the number of the first state.
fn attributes(variable: &Variable, reference: usize, first: usize) -> [String; 2] {
    let Variable { name, causality, unit, start, rate_of, meaning } = variable;
    let initial = match (*causality, start) {
        ("input", _) => "",
        (_, Some(_)) => " initial=\"exact\"",
        (_, None) => " initial=\"calculated\"",
    };
    let unit = unit.map(|unit| format!(" unit=\"{unit}\"")).unwrap_or_default();
    let start = start.map(|start| format!(" start=\"{}\"", number(start))).unwrap_or_default();
    let rate = rate_of.map(|state| format!(" derivative=\"{}\"", state + first)).unwrap_or_default();
    let of_variable = format!(
        "name=\"{name}\" valueReference=\"{reference}\" causality=\"{causality}\" variability=\"continuous\"{initial} description=\"{meaning}\""
    );
    [of_variable, format!("{unit}{start}{rate}")]
}

/// Attributes of the Boolean that says whether the state is within the range.
fn of_valid() -> String {
    format!(
        "name=\"valid\" valueReference=\"{VALID}\" causality=\"output\" variability=\"discrete\" initial=\"calculated\" \
         description=\"whether the equations do not fail\""
    )
}

fn write_units(out: &mut String) -> fmt::Result {
    writeln!(out, "  <UnitDefinitions>")?;
    UNITS.iter().try_for_each(|(name, exponents)| {
        writeln!(out, "    <Unit name=\"{name}\"><BaseUnit {exponents}/></Unit>")
    })?;
    writeln!(out, "  </UnitDefinitions>\n  <ModelVariables>")
}

fn write_two(out: &mut String, body: &FreeBody, token: &str) -> fmt::Result {
    let FreeBody { name, .. } = body;
    writeln!(
        out,
        "<fmiModelDescription fmiVersion=\"2.0\" modelName=\"{name}\" guid=\"{token}\" description=\"{}\" \
         generationTool=\"quasirigid\" variableNamingConvention=\"structured\" numberOfEventIndicators=\"0\">",
        description(body)
    )?;
    let states = "canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\"";
    let files = format!("<SourceFiles><File name=\"{name}.c\"/><File name=\"fmi-2.c\"/></SourceFiles>");
    writeln!(out, "  <ModelExchange modelIdentifier=\"{name}\" {states}>{files}</ModelExchange>")?;
    writeln!(
        out,
        "  <CoSimulation modelIdentifier=\"{name}\" canHandleVariableCommunicationStepSize=\"true\" {states}>{files}</CoSimulation>"
    )?;
    write_units(out)?;
    let variables = variables(body);
    for (reference, variable) in variables.iter().enumerate() {
        let [own, value] = attributes(variable, reference, 1);
        writeln!(out, "    <ScalarVariable {own}><Real{value}/></ScalarVariable>")?;
    }
    writeln!(out, "    <ScalarVariable {}><Boolean/></ScalarVariable>", of_valid())?;
    writeln!(out, "  </ModelVariables>\n  <ModelStructure>")?;
    for (name, references) in ["Outputs", "Derivatives", "InitialUnknowns"].iter().zip(unknowns(&variables)) {
        let list: String =
            references.iter().map(|reference| format!("<Unknown index=\"{}\"/>", reference + 1)).collect();
        writeln!(out, "    <{name}>{list}</{name}>")?;
    }
    writeln!(out, "  </ModelStructure>\n</fmiModelDescription>")
}

fn write_three(out: &mut String, body: &FreeBody, token: &str) -> fmt::Result {
    let FreeBody { name, .. } = body;
    writeln!(
        out,
        "<fmiModelDescription fmiVersion=\"3.0\" modelName=\"{name}\" instantiationToken=\"{token}\" description=\"{}\" \
         generationTool=\"quasirigid\" variableNamingConvention=\"structured\">",
        description(body)
    )?;
    let states = "canGetAndSetFMUState=\"true\" canSerializeFMUState=\"true\"";
    writeln!(out, "  <ModelExchange modelIdentifier=\"{name}\" {states}/>")?;
    writeln!(
        out,
        "  <CoSimulation modelIdentifier=\"{name}\" {states} canHandleVariableCommunicationStepSize=\"true\"/>"
    )?;
    write_units(out)?;
    writeln!(
        out,
        "    <Float64 name=\"time\" valueReference=\"{TIME}\" causality=\"independent\" variability=\"continuous\"/>"
    )?;
    let variables = variables(body);
    for (reference, variable) in variables.iter().enumerate() {
        let [own, value] = attributes(variable, reference, 0);
        writeln!(out, "    <Float64 {own}{value}/>")?;
    }
    writeln!(out, "    <Boolean {}/>", of_valid())?;
    writeln!(out, "  </ModelVariables>\n  <ModelStructure>")?;
    let names = ["Output", "ContinuousStateDerivative", "InitialUnknown"];
    for (name, references) in names.iter().zip(unknowns(&variables)) {
        for reference in references {
            writeln!(out, "    <{name} valueReference=\"{reference}\"/>")?;
        }
    }
    writeln!(out, "  </ModelStructure>\n</fmiModelDescription>")
}
