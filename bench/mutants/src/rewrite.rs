//! A file with all its mutants behind the switch.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::ops::Range;

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Block, Expr, ExprBinary, ExprMatch, ExprStruct, ExprUnary};

use crate::failure::Failure;
use crate::list::{Genre, Mutant, Place};

/// A mutant at a place: its number, and what stands instead.
#[derive(Clone, Debug)]
struct Choice {
    number: usize,
    replacement: String,
}

/// What is changed at a place.
#[derive(Debug)]
enum Change {
    /// Between two operands.
    Binary {
        left: Range<usize>,
        operator: String,
        right: Range<usize>,
    },
    /// Before an operand.
    Unary {
        operator: String,
        operand: Range<usize>,
    },
    /// At the start of a body.
    Body,
    /// An arm, whose pattern ends somewhere and whose condition stands somewhere.
    Arm { guard: Option<Range<usize>> },
    /// The value of a field, and that of the rest.
    Field {
        name: String,
        value: Range<usize>,
        rest: Range<usize>,
    },
}

/// A mutant that is behind the switch.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    /// Its number.
    pub number: usize,
    /// The number of its place.
    pub place: usize,
    /// Whether a run says if it gives another value there: comparisons do.
    pub compares: bool,
}

/// A place in a file: its bytes, what is changed, by which mutants.
#[derive(Debug)]
struct Node {
    bytes: Range<usize>,
    change: Change,
    choices: Vec<Choice>,
}

/// The places of a file.
struct Finder<'a> {
    source: &'a str,
    /// Mutants by the byte at which they begin.
    mutants: BTreeMap<usize, Vec<(Genre, Choice)>>,
    nodes: Vec<Node>,
}

impl Finder<'_> {
    fn take(&self, start: usize, genre: Genre) -> Vec<Choice> {
        let here = self.mutants.get(&start).into_iter().flatten();
        here.filter(|(of, _)| *of == genre)
            .map(|(_, choice)| choice.clone())
            .collect()
    }

    fn keep(&mut self, bytes: Range<usize>, change: Change, choices: Vec<Choice>) {
        if !choices.is_empty() {
            self.nodes.push(Node {
                bytes,
                change,
                choices,
            });
        }
    }

    fn text(&self, bytes: Range<usize>) -> String {
        self.source[bytes].to_owned()
    }
}

fn bytes(spanned: &impl Spanned) -> Range<usize> {
    let span: Span = spanned.span();
    span.byte_range()
}

fn compares(operator: &str) -> bool {
    matches!(operator, "==" | "!=" | "<" | "<=" | ">" | ">=")
}

/// Whether a condition binds names, so that its parts must stay where they are.
fn binds(expression: &Expr) -> bool {
    match expression {
        Expr::Let(_) => true,
        Expr::Binary(ExprBinary {
            left,
            op: BinOp::And(_),
            right,
            ..
        }) => binds(left) || binds(right),
        _ => false,
    }
}

impl<'a> Visit<'a> for Finder<'_> {
    fn visit_block(&mut self, block: &'a Block) {
        if let Some(first) = block.stmts.first() {
            let start = bytes(first).start;
            let choices = self.take(start, Genre::FnValue);
            self.keep(start..start, Change::Body, choices);
        }
        visit::visit_block(self, block);
    }

    fn visit_expr_binary(&mut self, node: &'a ExprBinary) {
        let operator = bytes(&node.op);
        let left = bytes(&node.left);
        let right = bytes(&node.right);
        if !(binds(&node.left) || binds(&node.right)) {
            let choices = self.take(operator.start, Genre::BinaryOperator);
            let change = Change::Binary {
                left: left.clone(),
                operator: self.text(operator),
                right: right.clone(),
            };
            self.keep(left.start..right.end, change, choices);
        }
        visit::visit_expr_binary(self, node);
    }

    fn visit_expr_unary(&mut self, node: &'a ExprUnary) {
        let operator = bytes(&node.op);
        let operand = bytes(&node.expr);
        let choices = self.take(operator.start, Genre::UnaryOperator);
        let change = Change::Unary {
            operator: self.text(operator.clone()),
            operand: operand.clone(),
        };
        self.keep(operator.start..operand.end, change, choices);
        visit::visit_expr_unary(self, node);
    }

    fn visit_expr_match(&mut self, node: &'a ExprMatch) {
        for arm in &node.arms {
            let pattern = bytes(&arm.pat);
            let guard = arm.guard.as_ref().map(|(_, guard)| bytes(guard));
            let start = arm
                .attrs
                .first()
                .map_or(pattern.start, |attribute| bytes(attribute).start);
            let mut choices: Vec<Choice> = self
                .take(start, Genre::MatchArm)
                .into_iter()
                .map(|choice| Choice {
                    replacement: String::from("false"),
                    ..choice
                })
                .collect();
            if let Some(guard) = &guard {
                choices.extend(self.take(guard.start, Genre::MatchArmGuard));
            }
            let end = guard.as_ref().map_or(pattern.end, |guard| guard.end);
            self.keep(pattern.end..end, Change::Arm { guard }, choices);
        }
        visit::visit_expr_match(self, node);
    }

    fn visit_expr_struct(&mut self, node: &'a ExprStruct) {
        if let Some(rest) = &node.rest {
            for field in &node.fields {
                let field_bytes = bytes(field);
                let choices = self.take(field_bytes.start, Genre::StructField);
                let name = self.text(bytes(&field.member));
                let change = Change::Field {
                    name,
                    value: bytes(&field.expr),
                    rest: bytes(rest),
                };
                self.keep(field_bytes, change, choices);
            }
        }
        visit::visit_expr_struct(self, node);
    }
}

/// The byte of a place.
fn byte(source: &str, lines: &[usize], place: Place) -> usize {
    let line = lines[place.line - 1];
    source[line..]
        .char_indices()
        .nth(place.column - 1)
        .map_or(source.len(), |(byte, _)| line + byte)
}

/// A file with the mutants in it, and which of them have a place.
pub fn rewritten(
    source: &str,
    mutants: &[(usize, &Mutant)],
) -> Result<(String, Vec<Placed>), Failure> {
    let lines: Vec<usize> = std::iter::once(0)
        .chain(source.match_indices('\n').map(|(byte, _)| byte + 1))
        .collect();
    let mut by_byte: BTreeMap<usize, Vec<(Genre, Choice)>> = BTreeMap::new();
    for &(number, mutant) in mutants {
        let choice = Choice {
            number,
            replacement: mutant.replacement.clone(),
        };
        let start = byte(source, &lines, mutant.span.start);
        by_byte
            .entry(start)
            .or_default()
            .push((mutant.genre, choice));
    }
    let mut finder = Finder {
        source,
        mutants: by_byte,
        nodes: Vec::new(),
    };
    finder.visit_file(&syn::parse_file(source)?);
    let mut nodes = finder.nodes;
    // The start of a body before what stands there, outer places before those inside them.
    nodes.sort_by_key(|node| {
        (
            node.bytes.start,
            !matches!(node.change, Change::Body),
            usize::MAX - node.bytes.end,
        )
    });
    let mut text = String::new();
    write(&mut text, source, 0..source.len(), &nodes)?;
    let placed = nodes.iter().flat_map(|node| {
        let compares =
            matches!(&node.change, Change::Binary { operator, .. } if compares(operator));
        let place = node.choices[0].number;
        node.choices.iter().map(move |choice| Placed {
            number: choice.number,
            place,
            compares,
        })
    });
    let placed = placed.collect();
    Ok((text, placed))
}

/// Writes a part of the file, with the places in it.
fn write(
    text: &mut String,
    source: &str,
    part: Range<usize>,
    nodes: &[Node],
) -> Result<(), Failure> {
    let mut from = part.start;
    let inside = |node: &&Node| node.bytes.start >= part.start && node.bytes.end <= part.end;
    for (index, node) in nodes.iter().enumerate().filter(|(_, node)| inside(node)) {
        if node.bytes.start < from {
            continue;
        }
        text.push_str(&source[from..node.bytes.start]);
        from = node.bytes.end;
        change(text, source, node, &nodes[index + 1..])?;
    }
    text.push_str(&source[from..part.end]);
    Ok(())
}

fn change(text: &mut String, source: &str, node: &Node, inner: &[Node]) -> Result<(), Failure> {
    let place = node.choices[0].number;
    let at = format!("crate::mutant::at({place})");
    match &node.change {
        Change::Body => {
            for Choice {
                number,
                replacement,
            } in &node.choices
            {
                writeln!(
                    text,
                    "\n/*m{number}*/ if {at} == {number} {{ return {replacement}; }}"
                )?;
            }
        }
        Change::Binary {
            left,
            operator,
            right,
        } => binary(text, source, node, inner, (left, operator, right))?,
        Change::Unary { operator, operand } => {
            let value = format!("value_{place}");
            write!(text, "({{\n/*m{place}*/ let {value} = ")?;
            write(text, source, operand.clone(), inner)?;
            write!(
                text,
                ";\n/*m{place}*/ if {at} == {place} {{ {value} }} else {{ {operator}{value} }} }})"
            )?;
        }
        Change::Arm { guard } => {
            write!(text, " if (match {at} {{")?;
            for Choice {
                number,
                replacement,
            } in &node.choices
            {
                write!(text, "\n/*m{number}*/ {number} => {replacement},")?;
            }
            write!(text, "\n_ => ")?;
            match guard {
                Some(guard) => write(text, source, guard.clone(), inner)?,
                None => text.push_str("true"),
            }
            write!(text, " }})")?;
        }
        Change::Field { name, value, rest } => {
            write!(text, "{name}: if {at} == {place} {{\n/*m{place}*/ (")?;
            text.push_str(&source[rest.clone()]);
            write!(text, ").{name}\n}} else {{ ")?;
            write(text, source, value.clone(), inner)?;
            write!(text, " }}")?;
        }
    }
    Ok(())
}

fn binary(
    text: &mut String,
    source: &str,
    node: &Node,
    inner: &[Node],
    (left, operator, right): (&Range<usize>, &str, &Range<usize>),
) -> Result<(), Failure> {
    let place = node.choices[0].number;
    // Names of their own: an operand must not find another one's value under a name of the source.
    let (first, second) = (format!("left_{place}"), format!("right_{place}"));
    let marks = node.choices.iter().fold(String::new(), |marks, choice| {
        format!("{marks}/*m{}*/", choice.number)
    });
    let lazy = operator == "&&" || operator == "||";
    let compares = compares(operator);
    let assigns = operator.ends_with('=') && !compares;
    write!(text, "({{")?;
    if compares {
        write!(text, "\n{marks} match (&(")?;
        write(text, source, left.clone(), inner)?;
        write!(text, "), &(")?;
        write(text, source, right.clone(), inner)?;
        write!(text, ")) {{ ({first}, {second}) => {{")?;
        for Choice {
            number,
            replacement,
        } in &node.choices
        {
            write!(
                text,
                "\n/*m{number}*/ crate::mutant::differs({number}, \
                 (*{first} {replacement} *{second}) != (*{first} {operator} *{second}));"
            )?;
        }
    } else if !assigns {
        write!(text, "\n{marks} let {first} = ")?;
        write(text, source, left.clone(), inner)?;
        write!(text, ";")?;
    }
    if !compares && !lazy {
        write!(text, "\n{marks} let {second} = ")?;
        write(text, source, right.clone(), inner)?;
        write!(text, ";")?;
    }
    write!(text, "\nmatch crate::mutant::at({place}) {{")?;
    let plain = Choice {
        number: 0,
        replacement: operator.to_owned(),
    };
    for Choice {
        number,
        replacement,
    } in node.choices.iter().chain([&plain])
    {
        match number {
            0 => write!(text, "\n_ => ")?,
            _ => write!(text, "\n/*m{number}*/ {number} => ")?,
        }
        if compares {
            write!(text, "*{first} {replacement} *{second},")?;
        } else if lazy {
            write!(text, "{first} {replacement} (")?;
            write(text, source, right.clone(), inner)?;
            write!(text, "),")?;
        } else if assigns {
            write(text, source, left.clone(), inner)?;
            write!(text, " {replacement} {second},")?;
        } else {
            write!(text, "{first} {replacement} {second},")?;
        }
    }
    write!(text, "\n}}")?;
    if compares {
        write!(text, " }} }}")?;
    }
    write!(text, " }})")?;
    Ok(())
}
