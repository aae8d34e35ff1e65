//! Reads what the harness tells, message by message; see `assets/harness/recorder.hpp`.

use glam::Vec3;
use grading::text::printable;
use photon_mapping::photon_list::{PhotonRecord, ROW_BYTES};

use crate::events::{AROUND_BINS, Call, Log, Notice, StepLog, Stored, Trace};

/// The bytes of the key that stands before every piece.
const KEY_BYTES: usize = 8;
/// The longest piece.
const LONGEST: usize = 1 << 16;

/// Reads messages from bytes that come in any portions.
#[derive(Debug, Default)]
pub struct Reader {
    key: Option<[u8; KEY_BYTES]>,
    /// What is no whole piece yet.
    waiting: Vec<u8>,
    /// What is no whole message yet.
    messages: Vec<u8>,
}

impl Reader {
    /// Adds what `portion` tells to `log`.
    pub fn read(&mut self, portion: &[u8], log: &mut Log) {
        self.waiting.extend_from_slice(portion);
        let mut pieces = Bytes { bytes: &self.waiting, at: 0 };
        let (mut read, mut is_forged) = (0, false);
        if self.key.is_none() {
            self.key = pieces.array();
            read = pieces.at;
        }
        while let (Some(key), Some(found)) = (self.key, pieces.array()) {
            let Some(length) = pieces.u32() else { break };
            if found != key || length as usize > LONGEST {
                is_forged = true;
                break;
            }
            let Some(piece) = pieces.take(length as usize) else { break };
            self.messages.extend_from_slice(piece);
            read = pieces.at;
        }
        self.waiting.drain(..read);
        let mut at = 0;
        while !log.is_broken {
            let Some(length) = message(&self.messages[at..], log) else { break };
            at += length;
        }
        self.messages.drain(..at);
        // What came before it is true.
        log.is_broken |= is_forged;
    }
}

/// Reads one message from the start of `bytes`; its length, or nothing if it is not all there.
fn message(bytes: &[u8], log: &mut Log) -> Option<usize> {
    let mut rest = Bytes { bytes, at: 1 };
    let kind = *bytes.first()?;
    match kind {
        b'B' => {
            let number = rest.u32()? as usize;
            if number < 1000 {
                log.current = Some(number);
                if log.steps.len() <= number {
                    log.steps.resize_with(number + 1, StepLog::default);
                }
            } else {
                log.is_broken = true;
            }
        }
        b'N' => step(log).calls.push(Call::default()),
        b'R' => {
            let ray = [rest.vector()?, rest.vector()?];
            call(log).emitted = Some(ray);
        }
        b'T' => {
            let (from, direction) = (rest.vector()?, rest.vector()?);
            let bits = rest.u8()?;
            let t = rest.f32()?;
            let _object = rest.u16()?;
            let triangle = rest.u16()?;
            let (met, has_state) = (bits & 1 != 0, bits & 2 != 0);
            call(log).traces.push(Trace { from, direction, met, has_state, t, triangle });
        }
        b'P' => {
            let stored = Stored {
                position: rest.vector()?,
                intensity: rest.vector()?,
                to_light: rest.vector()?,
            };
            call(log).stored.push(stored);
        }
        b'E' => {
            let (drawn, seeded_again) = (rest.u32()?, rest.u32()?);
            let call = call(log);
            (call.drawn, call.seeded_again, call.ended) = (drawn, seeded_again, true);
        }
        b'X' => {
            let length = rest.u16()? as usize;
            let text = String::from_utf8_lossy(rest.take(length)?).into_owned();
            // A line of its own could read as another's report.
            call(log).exception = Some(printable(&text));
        }
        b'W' => {
            let row = rest.take(ROW_BYTES)?;
            let mut row = Bytes { bytes: row, at: 0 };
            log.whole.records.push(PhotonRecord {
                position: row.vector()?,
                intensity: row.vector()?,
                to_light: row.vector()?,
                photon: row.u32()?,
                bounce: row.u16()?,
                surface: row.u16()?,
            });
        }
        b'C' => log.whole.counts = Some([rest.u64()?, rest.u64()?, rest.u64()?, rest.u64()?]),
        b'A' => {
            let counts = rest.take(4 * AROUND_BINS)?.chunks_exact(4);
            let number = |bytes: &[u8]| bytes.try_into().map_or(0, u32::from_ne_bytes);
            step(log).around.push(counts.map(number).collect());
        }
        b'L' => log.whole.is_too_long = true,
        b'U' => step(log).other_signature = true,
        b'S' => {
            log.notices.extend(match rest.u8()? {
                1 => Some(Notice::RandomDevice),
                2 => Some(Notice::Process),
                3 => Some(Notice::NotGuarded),
                _ => None,
            });
        }
        b'O' => log.stack_overflowed = true,
        b'M' => log.memory_ran_out = true,
        b'Q' => step(log).ended = true,
        b'Z' => log.is_complete = true,
        _ => log.is_broken = true,
    }
    Some(rest.at)
}

fn step(log: &mut Log) -> &mut StepLog {
    let current = log.current.unwrap_or_default();
    if log.steps.len() <= current {
        log.steps.resize_with(current + 1, StepLog::default);
    }
    &mut log.steps[current]
}

fn call(log: &mut Log) -> &mut Call {
    let calls = &mut step(log).calls;
    if calls.is_empty() {
        calls.push(Call::default());
    }
    calls.last_mut().expect("there is one")
}

struct Bytes<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Bytes<'a> {
    fn take(&mut self, length: usize) -> Option<&'a [u8]> {
        let taken = self.bytes.get(self.at..self.at + length)?;
        self.at += length;
        Some(taken)
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }

    fn u8(&mut self) -> Option<u8> {
        self.array().map(u8::from_ne_bytes)
    }

    fn u16(&mut self) -> Option<u16> {
        self.array().map(u16::from_ne_bytes)
    }

    fn u32(&mut self) -> Option<u32> {
        self.array().map(u32::from_ne_bytes)
    }

    fn u64(&mut self) -> Option<u64> {
        self.array().map(u64::from_ne_bytes)
    }

    fn f32(&mut self) -> Option<f32> {
        self.array().map(f32::from_ne_bytes)
    }

    fn vector(&mut self) -> Option<Vec3> {
        Some(Vec3::new(self.f32()?, self.f32()?, self.f32()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(portions: &[&[u8]]) -> Log {
        let (mut reader, mut log) = (Reader::default(), Log::default());
        portions.iter().for_each(|portion| reader.read(portion, &mut log));
        log
    }

    fn piece(key: &[u8], messages: &[u8]) -> Vec<u8> {
        let length = u32::try_from(messages.len()).expect("it is short").to_ne_bytes();
        [key, &length, messages].concat()
    }

    #[test]
    fn pieces_and_messages_may_end_anywhere() {
        let key = b"12345678";
        let begins = [&b"B"[..], &4_u32.to_ne_bytes()].concat();
        let pieces = [piece(key, &begins[..2]), piece(key, &begins[2..]), piece(key, b"Q")];
        let all = [&key[..], &pieces.concat()].concat();
        for cut in 0..all.len() {
            let log = read(&[&all[..cut], &all[cut..]]);
            assert!(!log.is_broken && log.steps[4].ended, "cut at {cut}: {log:?}");
        }
    }

    /// What a submission writes to the pipe by itself tells nothing.
    #[test]
    fn a_piece_with_another_key_is_told() {
        let key = b"12345678";
        let forged = [&key[..], &piece(b"87654321", b"Z")].concat();
        let log = read(&[&forged]);
        assert!(log.is_broken && !log.is_complete);
    }
}
