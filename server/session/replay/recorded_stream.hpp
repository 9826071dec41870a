#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "case/case.hpp"
#include "core/progress.hpp"
#include "record/recording.hpp"
#include "score/native_glenoid.hpp"
#include "session/running_replay.hpp"
#include "shell/tool.hpp"
#include "stream/messages.hpp"

namespace ream::session {

/// What viewers are told of a recording first, but for the tool and the ids of session, server and replay.
/// `start`: its case, the bone before tick 0. Error invalid_input for settings that cannot be read.
stream::HelloInfo recorded_hello(const record::Recording& recording, const case_::Case& start);

/// Changes of the reamer, events and annotations, in order of time.
std::vector<ReplayMark> recorded_marks(const record::Recording& recording);

/// The tool of a segment. Errors: invalid_input where the recording lacks it, and as tool_of().
shell::Tool tool_of_segment(const record::Recording& recording, size_t segment);

/// A message that holds when so many ticks have passed.
struct RecordedMessage {
  uint32_t at_ticks = 0;
  stream::Message message;
};

/// What a replay tells its viewers of a recording, but for the bone: the hello, then telemetry of every
/// `interval_ticks`-th moment from 0 to the end, and each other tool before the moment that has it. For
/// viewers who have no server. `native` null: the depth is not known. Errors: those of Recording.
std::vector<RecordedMessage> recorded_stream(const record::Recording& recording, const case_::Case& start,
                                             const std::shared_ptr<const score::NativeGlenoid>& native,
                                             stream::HelloInfo hello, uint32_t interval_ticks,
                                             const Progress& progress);

}  // namespace ream::session
