//! What a record itself suggests doing with its channels before their methods see them.

use rayon::prelude::*;
use wildpoint_core::suggestions::Suggestion;

use super::{Preparation, Session};
use crate::track::{Channel, Track};

/// What the values of `channel` suggest.
#[must_use]
pub fn suggestions(channel: &Channel) -> Vec<Suggestion> {
    wildpoint_core::suggestions::suggestions(&channel.name, &channel.unit, &channel.values)
}

/// What is certain of what the values of `channel` suggest.
#[must_use]
pub fn suggested(channel: &Channel) -> Preparation {
    Preparation::certain(suggestions(channel))
}

impl Session {
    /// The same with what is certain of what the record suggests, for a new session. It is written into the session, so
    /// that later versions cannot suggest anything else.
    #[must_use]
    pub fn with_suggestions(mut self, track: &Track) -> Self {
        self.plans.par_iter_mut().for_each(|plan| {
            if let Some(channel) = track.channel(&plan.channel) {
                plan.setup.preparation = suggested(channel);
            }
        });
        self
    }
}
