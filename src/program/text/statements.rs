//! Parses statements.

use super::call::Written;
use super::lex::Token;
use super::syntax::{Parse, Parser};

impl Parser<'_> {
    pub(super) fn statements(&mut self) -> Parse<()> {
        loop {
            while self.tokens.peek() == Some(&Token::End) {
                self.tokens.skip(1);
            }
            if self.tokens.peek().is_none() {
                return self.check_all_called();
            }
            match self.tokens.definition() {
                Some(_) => self.tokens.skip_statement(),
                None => self.statement()?,
            }
            self.check_ended()?;
        }
    }

    /// Checks that a statement ends here.
    pub(super) fn check_ended(&self) -> Parse<()> {
        match self.tokens.peek() {
            None | Some(Token::End) => Ok(()),
            Some(Token::Symbol('?')) => {
                let message = "`?` needs a comparison before it, as in `a < b ? x : y`";
                self.tokens.error(self.tokens.offset(), message)
            }
            Some(_) => {
                let message = "expected an operator, or `;` before the next statement";
                self.tokens.error(self.tokens.offset(), message)
            }
        }
    }

    /// Parses `name = expression`, or for vectors `(x, y) = expression`.
    fn statement(&mut self) -> Parse<()> {
        let start = self.tokens.offset();
        let names = match (self.tokens.peek().cloned(), self.tokens.peek_second()) {
            (Some(Token::Name(name)), Some(Token::Symbol('='))) => {
                self.tokens.skip(2);
                vec![(start, name)]
            }
            (Some(Token::Symbol('(')), _) => self.names()?,
            _ => return self.no_statement(start),
        };
        for (place, (at, name)) in names.iter().enumerate() {
            self.tokens.placed(*at, self.definitions.check_assignable(name))?;
            if names[..place].iter().any(|(_, earlier)| earlier == name) {
                return self.tokens.error(*at, format!("`{name}` is assigned twice"));
            }
        }
        let at = self.tokens.offset();
        let value = self.wanting(names.len())?;
        match names.as_slice() {
            [(_, name)] => self.definitions.assign(name.clone(), value),
            names if names.len() == value.len() => {
                for ((_, name), component) in names.iter().zip(value) {
                    self.definitions.assign(name.clone(), vec![component]);
                }
            }
            names => {
                let (wanted, given) = (names.len(), value.len());
                let message = format!("{wanted} names, but the value has {given} components");
                return self.tokens.error(at, message);
            }
        }
        Ok(())
    }

    fn no_statement<T>(&self, at: usize) -> Parse<T> {
        let example = self.definitions.example();
        let message = format!("expected `name = expression`, as in `{example} = …`");
        self.tokens.error(at, message)
    }

    /// Parses `(x, y) =`, and returns the names with their places.
    fn names(&mut self) -> Parse<Vec<(usize, String)>> {
        let start = self.tokens.offset();
        self.tokens.skip(1);
        let mut names = Vec::new();
        loop {
            let at = self.tokens.offset();
            let Some(Token::Name(name)) = self.tokens.peek().cloned() else {
                return self.no_statement(start);
            };
            self.tokens.skip(1);
            names.push((at, name));
            if self.tokens.take_symbol(')') {
                self.tokens.expect('=', "after the names, as in `(x, y) = …`")?;
                return Ok(names);
            }
            self.tokens.expect(',', "between the names, as in `(x, y) = …`")?;
        }
    }

    /// Notes the functions that the text defines, wherever they stand.
    pub(super) fn collect_written(&mut self) -> Parse<()> {
        for (start, (name, parameters, body)) in self.tokens.definitions() {
            if super::functions::names().any(|known| known == name) {
                let message = format!("`{name}` is an operation; give the function another name");
                return self.tokens.error(start, message);
            }
            let twice = (1..parameters.len()).find(|&i| parameters[..i].contains(&parameters[i]));
            if let Some(place) = twice {
                let message = format!("two parameters are called `{}`", parameters[place]);
                return self.tokens.error(start, message);
            }
            let written = Written { parameters, body, start, is_called: false };
            if self.written.insert(name.clone(), written).is_some() {
                return self.tokens.error(start, format!("`{name}` is defined twice"));
            }
        }
        Ok(())
    }

    fn check_all_called(&self) -> Parse<()> {
        let idle = self.written.iter().filter(|(_, written)| !written.is_called);
        match idle.min_by_key(|(_, written)| written.start) {
            None => Ok(()),
            Some((name, written)) => {
                let message = format!("`{name}` is defined, but never called");
                self.tokens.error(written.start, message)
            }
        }
    }
}
