#pragma once
#include <cstdint>
#include <functional>
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

/// Whether the second reamer is made as the first.
bool same_reamer(const record::ops::Segment& first, const record::ops::Segment& second);

/// What a message of a recording is.
enum class RecordedMessage { hello, telemetry, tool };

/// Takes a message that holds when so many ticks have passed.
using TakeMessage = std::function<void(RecordedMessage kind, uint32_t at_ticks, const stream::Message&)>;

/// What a replay tells its viewers of a recording's first `ticks` ticks, but for the bone: the hello, then
/// telemetry of every `interval_ticks`-th moment from 0 to the end, and each other tool before the first
/// moment that has it. For viewers who have no server. `native` null: the depth is not known. Errors: those
/// of Recording and of tool_of_segment(); what `take` and `progress` throw.
void recorded_stream(const record::Recording& recording, const case_::Case& start,
                     const std::shared_ptr<const score::NativeGlenoid>& native, stream::HelloInfo hello,
                     uint32_t ticks, uint32_t interval_ticks, const TakeMessage& take,
                     const Progress& progress);

}  // namespace ream::session
