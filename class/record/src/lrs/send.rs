//! Sends waiting statements.

use std::thread::sleep;

use serde_json::Value;
use uuid::Uuid;

use super::client::{Answer, Client};
use super::{Lrs, Patience};
use crate::store::{Store, StoreError, Waiting};

/// Statements in a request. Our choice: some 100 kB, which every server takes.
const BATCH: usize = 50;

/// Refused statements after which the store is taken to refuse all of ours. Our choice.
const MOST_REFUSED: usize = 10;

/// Result of sending.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sent {
    /// Statements that were delivered.
    pub delivered: u64,
    /// Statements that wait still.
    pub waiting: u64,
    /// Those of them that the store refused. They are sent again at the next request, after all others.
    pub refused: Vec<Refused>,
    /// Why sending stopped early: the store is unreachable, does not accept the sender, or refuses everything. `None` if it did not stop.
    pub stopped: Option<String>,
}

/// A statement that a Learning Record Store refused.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// The statement's identifier.
    pub id: Uuid,
    /// The store's message.
    pub why: String,
}

/// Sends all statements that wait for this Learning Record Store. If it is unreachable, statements that it has not confirmed stay and wait
/// for the next call, under the same identifiers.
///
/// # Errors
/// [`StoreError`] of the class's file. A failure to send is no error but a part of [`Sent`].
pub fn send(store: &mut Store, lrs: &Lrs) -> Result<Sent, StoreError> {
    let address = lrs.endpoint.as_str();
    let mut sending = Sending {
        client: Client::new(lrs),
        patience: lrs.patience,
        store,
        sent: Sent::default(),
    };
    for numbers in sending.store.numbers(address)?.chunks(BATCH) {
        let batch = sending.store.at(numbers)?;
        if !batch.is_empty() && !sending.deliver(batch)? {
            break;
        }
    }
    let mut sent = sending.sent;
    sent.waiting = store.waiting(address)?;
    Ok(sent)
}

struct Sending<'a> {
    client: Client<'a>,
    patience: Patience,
    store: &'a mut Store,
    sent: Sent,
}

impl Sending<'_> {
    /// Sends a batch, in halves where a part of it is refused, so that one statement holds no other back. Returns whether to go on.
    fn deliver(&mut self, batch: Vec<Waiting>) -> Result<bool, StoreError> {
        let mut parts = vec![batch];
        while let Some(part) = parts.pop() {
            let text: Vec<&str> = part.iter().map(|it| it.statement.as_str()).collect();
            let text = format!("[{}]", text.join(","));
            match self.patiently(|client| client.store(&text)) {
                Answer::Stored => self.delivered(&part)?,
                Answer::Conflict(why) => {
                    let Some(missing) = self.not_there(&part, &why)? else {
                        return Ok(false);
                    };
                    if missing.len() == part.len() {
                        // Which of them conflict shows only when they are sent apart.
                        parts.extend(self.apart(missing, &why)?);
                    } else if !missing.is_empty() {
                        parts.push(missing);
                    }
                }
                Answer::Refused(why) => parts.extend(self.apart(part, &why)?),
                Answer::Denied(why) | Answer::Away(why, _) => {
                    self.sent.stopped = Some(why);
                    return Ok(false);
                }
            }
            if self.sent.refused.len() >= MOST_REFUSED {
                self.sent.stopped = Some(format!("{MOST_REFUSED} statements were refused"));
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The halves of a part that was refused, the first one last. A single statement has none: it is refused.
    fn apart(
        &mut self,
        mut part: Vec<Waiting>,
        why: &str,
    ) -> Result<Vec<Vec<Waiting>>, StoreError> {
        if let [waiting] = &part[..] {
            self.refused(waiting, why)?;
            return Ok(Vec::new());
        }
        let second = part.split_off(part.len() / 2);
        Ok(vec![second, part])
    }

    /// Looks up each statement of a part that conflicted. Those that are stored already are delivered; returns those that are not, or
    /// `None` where the store stopped answering. A token may write statements and not read them: then nothing is known of the rest.
    fn not_there(
        &mut self,
        part: &[Waiting],
        why: &str,
    ) -> Result<Option<Vec<Waiting>>, StoreError> {
        let mut missing = Vec::new();
        for (at, waiting) in part.iter().enumerate() {
            let mut found = None;
            let answer = self.patiently(|client| match client.find(waiting.id) {
                Ok(statement) => {
                    found = statement;
                    Answer::Stored
                }
                Err(answer) => answer,
            });
            match (answer, found) {
                (Answer::Stored, Some(there)) if is_same(&there, &waiting.statement) => {
                    self.delivered(std::slice::from_ref(waiting))?;
                }
                (Answer::Stored, Some(_)) => {
                    self.refused(
                        waiting,
                        &format!("it holds another of that identifier: {why}"),
                    )?;
                }
                (Answer::Stored, None) => missing.push(waiting.clone()),
                (Answer::Conflict(_) | Answer::Refused(_) | Answer::Denied(_), _) => {
                    missing.extend_from_slice(&part[at..]);
                    break;
                }
                (Answer::Away(why, _), _) => {
                    self.sent.stopped = Some(why);
                    return Ok(None);
                }
            }
        }
        Ok(Some(missing))
    }

    fn delivered(&mut self, statements: &[Waiting]) -> Result<(), StoreError> {
        self.store.delivered(statements)?;
        self.sent.delivered += statements.len() as u64;
        Ok(())
    }

    fn refused(&mut self, waiting: &Waiting, why: &str) -> Result<(), StoreError> {
        self.store.refused(waiting, why)?;
        self.sent.refused.push(Refused {
            id: waiting.id,
            why: why.to_owned(),
        });
        Ok(())
    }

    /// Repeats a request, with growing pauses, while the store is unreachable.
    fn patiently(&self, mut ask: impl FnMut(&Client<'_>) -> Answer) -> Answer {
        let mut pause = self.patience.pause;
        for _ in 1..self.patience.tries {
            match ask(&self.client) {
                Answer::Away(_, wanted) => {
                    sleep(wanted.unwrap_or(pause).min(self.patience.longest))
                }
                answer => return answer,
            }
            pause = pause.saturating_mul(2);
        }
        ask(&self.client)
    }
}

/// Whether a stored statement of the same identifier has the same content. A store adds to a statement, and may write a number or a time
/// in another way: so actor, verb, object and attempt are compared.
fn is_same(there: &Value, sent: &str) -> bool {
    let Ok(sent) = serde_json::from_str::<Value>(sent) else {
        return false;
    };
    let same = |path| there.pointer(path) == sent.pointer(path);
    [
        "/actor/account",
        "/verb/id",
        "/object/id",
        "/context/registration",
    ]
    .into_iter()
    .all(same)
}
