//! What the typed formulas mean, and what the errors say.

use implicit::glam::DVec3;
use implicit::{Formula, FormulaErrorKind, ImplicitField};

const P: DVec3 = DVec3::new(0.5, -2.0, 3.0);

#[track_caller]
fn check_value(text: &str, expected: f64) {
    let value = match Formula::parse(text) {
        Ok(formula) => formula.value(P),
        Err(error) => panic!("{error}"),
    };
    let tolerance = 4.0 * f64::EPSILON * expected.abs();
    assert!((value - expected).abs() <= tolerance, "{text} = {value}, not {expected}");
}

#[track_caller]
fn check_error(text: &str, column: usize, kind: &FormulaErrorKind) {
    let error = Formula::parse(text).expect_err(text);
    assert_eq!(error.kind(), kind, "{text}");
    assert_eq!(error.column(), column, "{error}");
}

#[test]
fn precedence() {
    let (x, y, z) = (P.x, P.y, P.z);
    for (text, expected) in [
        ("-x^2", -(x * x)),
        ("(-x)^2", x * x),
        ("2^-1", 0.5),
        ("-2^-2", -0.25),
        ("2^3^2", 512.0),
        ("(2^3)^2", 64.0),
        ("2^-x^2", 2.0_f64.powf(-(x * x))),
        ("exp(-x^2)", (-x * x).exp()),
        ("2*x^2", 2.0 * x * x),
        ("-x*y", -x * y),
        ("x - y - z", x - y - z),
        ("x - (y - z)", x - (y - z)),
        ("z / y / x", z / y / x),
        ("z / y * x", z / y * x),
        ("x + y * z", x + y * z),
        ("(x + y) * z", (x + y) * z),
        ("x - -y", x + y),
        ("x*-y", -x * y),
        ("--x", x),
        ("+x", x),
        ("1 = 2", -1.0),
        ("x = y + z", x - y - z),
        ("x*y = z", x * y - z),
    ] {
        check_value(text, expected);
    }
}

#[test]
fn numbers_names_and_functions() {
    let (x, y, z) = (P.x, P.y, P.z);
    for (text, expected) in [
        ("pi", std::f64::consts::PI),
        ("2*π*x", std::f64::consts::TAU * x),
        (".5 + 2. + 1e-3 + 2.5E+2", 0.5 + 2.0 + 1e-3 + 250.0),
        ("sqrt(z)", z.sqrt()),
        ("exp(x) + ln(z)", x.exp() + z.ln()),
        ("sin(x) + cos(y) + tan(z)", x.sin() + y.cos() + z.tan()),
        ("atan2(y, x)", y.atan2(x)),
        ("tanh(abs(y))", 2.0_f64.tanh()),
        ("min(x, y) + max(y, z)", y + z),
        ("y^2 + y^3 + y^-3", 4.0 - 8.0 - 0.125),
        ("x^0.5 + z^1.5", x.sqrt() + z.powf(1.5)),
        ("z^x", z.powf(x)),
        ("y^0", 1.0),
        ("\tx\n + y ", x + y),
        ("3/x", 6.0),
        ("1 - x", 0.5),
    ] {
        check_value(text, expected);
    }
}

#[test]
fn named_constants() {
    let constants = [("r".to_owned(), 2.0), ("shift_1".to_owned(), -0.25)];
    let formula = Formula::parse_with("x^2 + shift_1 = r^2", &constants).unwrap();
    assert_eq!(formula.value(DVec3::ONE).to_bits(), (-3.25_f64).to_bits());
    assert_eq!(formula.to_string(), "x^2 + shift_1 = r^2");
    assert_eq!(formula.self_contained_text(), "x^2 + (-0.25) = (2.0)^2");
    let again = Formula::parse(formula.self_contained_text()).unwrap();
    assert_eq!(again.value(P).to_bits(), formula.value(P).to_bits());
}

#[test]
fn unusable_constants() {
    for (name, value) in [
        ("x", 1.0),
        ("sin", 1.0),
        ("pi", 3.0),
        ("r", f64::NAN),
        ("2r", 1.0),
        ("", 1.0),
        ("a b", 1.0),
    ] {
        let error = Formula::parse_with("x", &[(name, value)]).unwrap_err();
        let is_expected = matches!(error.kind(), FormulaErrorKind::InvalidConstant { .. });
        assert!(is_expected && !error.to_string().contains('^'), "{name}: {error}");
    }
    let twice = Formula::parse_with("a", &[("a", 1.0), ("a", 2.0)]);
    assert!(twice.is_err(), "a constant given twice");
}

#[test]
fn common_subexpressions_are_shared() {
    for (text, count) in [
        ("(x + y)^2 + (y + x)^2*z", 4),
        ("x*x + x^2", 2),
        ("2*3*x", 1),
        ("x + 0", 0),
        ("1*x/1", 0),
        ("x^1", 0),
        ("sin(2)*cos(1)", 1),
        ("(x - 1)^0 + z", 1),
    ] {
        assert_eq!(Formula::parse(text).unwrap().operation_count(), count, "{text}");
    }
}

#[test]
fn errors_point_at_the_place() {
    use FormulaErrorKind as Kind;
    check_error("", 1, &Kind::Empty);
    check_error("  \n ", 1, &Kind::Empty);
    check_error("x $ y", 3, &Kind::UnexpectedCharacter('$'));
    check_error("x + 1e999", 5, &Kind::InvalidNumber("1e999".into()));
    check_error("x + .", 5, &Kind::InvalidNumber(".".into()));
    check_error("(x + y", 7, &Kind::MissingParenthesis { opened: 1 });
    check_error("sin(x", 6, &Kind::MissingParenthesis { opened: 4 });
    check_error("x + y)", 6, &Kind::UnmatchedParenthesis);
    check_error("x = y = z", 7, &Kind::SecondEquality);
    check_error("sin x", 1, &Kind::MissingArguments("sin".into()));
    let count =
        |name: &str, expected, found| Kind::ArgumentCount { name: name.into(), expected, found };
    check_error("1 + sin(x, y)", 5, &count("sin", 1, 2));
    check_error("atan2(x)", 1, &count("atan2", 2, 1));
    check_error("min()", 1, &count("min", 2, 0));
    check_error("x + 1/0", 6, &Kind::NotFinite(f64::INFINITY));
    check_error("x*exp(1000)", 3, &Kind::NotFinite(f64::INFINITY));
    check_error("0^-1", 2, &Kind::NotFinite(f64::INFINITY));
}

#[test]
fn errors_say_what_was_expected() {
    for (text, column, found) in [
        ("x +", 4, "the end of the text"),
        ("x + * y", 5, "`*`"),
        ("()", 2, "`)`"),
        ("x^", 3, "the end of the text"),
        ("= x", 1, "`=`"),
        ("x ** y", 4, "`*`"),
        ("min(x,, y)", 7, "`,`"),
    ] {
        let kind = FormulaErrorKind::Unexpected {
            expected: "a number, a name or `(`",
            found: found.into(),
        };
        check_error(text, column, &kind);
    }
}

#[test]
fn a_missing_operator_is_named() {
    for (text, column, left, right) in [
        ("2x", 2, "2", "x"),
        ("x y", 3, "x", "y"),
        ("x(y + 1)", 2, "x", "("),
        ("(x)(y)", 4, ")", "("),
        ("x^2 + 3 sin(y)", 9, "3", "sin"),
        ("(2 x)", 4, "2", "x"),
    ] {
        let kind = FormulaErrorKind::MissingOperator { left: left.into(), right: right.into() };
        check_error(text, column, &kind);
    }
}

#[test]
fn unknown_names_get_a_hint() {
    for (text, hint) in [
        ("sqr(x)", "did you mean `sqrt`?"),
        ("cso(x)", "did you mean `cos`?"),
        ("Pi*x", "did you mean `pi`?"),
        ("X^2", "did you mean `x`?"),
        ("log(x)", "the natural logarithm is `ln`"),
        ("e^x", "write `exp(1)`"),
        (
            "width",
            "known are x, y, z, pi, π, sqrt, exp, ln, sin, cos, tan, tanh, abs, atan2, min, max",
        ),
    ] {
        let error = Formula::parse(text).unwrap_err();
        let FormulaErrorKind::UnknownName { hint: given, .. } = error.kind() else {
            panic!("{text}: {error}")
        };
        assert_eq!(given, hint, "{text}");
    }
}

#[test]
fn the_caret_counts_characters_of_its_line() {
    let error = Formula::parse("π*x +\n  π*foo + y").unwrap_err();
    assert!(error.to_string().ends_with("\n    π*foo + y\n      ^"), "{error}");
    assert_eq!((error.offset(), error.column()), (12, 5));
}

#[test]
fn nesting_is_limited() {
    let nested = |depth: usize| format!("{}x{}", "(".repeat(depth), ")".repeat(depth));
    assert!(Formula::parse(&nested(100)).is_ok(), "100 parentheses");
    for text in [nested(100_000), "-".repeat(100_000) + "x", "x^".repeat(100_000) + "x"] {
        let error = Formula::parse(&text).unwrap_err();
        assert_eq!(error.kind(), &FormulaErrorKind::TooDeep(128));
    }
}

#[test]
fn length_is_limited_but_not_short() {
    let sum = |terms: usize| vec!["x"; terms].join("+");
    assert!(Formula::parse(&sum(100_000)).is_ok(), "200 kB");
    let error = Formula::parse(&sum(1_000_000)).unwrap_err();
    assert!(matches!(error.kind(), FormulaErrorKind::TooLong(_)), "2 MB");
}
