#pragma once
#include <filesystem>
#include <type_traits>

#include "record/log_sink.hpp"
#include "record/op_log.hpp"
#include "record/ops.hpp"
#include "record/recording.hpp"

namespace ream::test {

/// What a program that is killed leaves of a recording: ticks whose bricks never came from `tick` on, and no
/// end.
inline std::filesystem::path killed_recording(const std::filesystem::path& whole,
                                              const std::filesystem::path& cut, uint32_t tick) {
  const record::OpLogReader reader(whole);
  record::OpLogWriter writer(record::create_log_file(cut));
  for (size_t i = 0; i < reader.chunks().size(); ++i) {
    record::ops::read(reader.read_chunk(i), reader.revision(), [&](const auto& op) {
      using Op = std::remove_cvref_t<decltype(op)>;
      if constexpr (std::is_same_v<Op, record::ops::Bricks> || std::is_same_v<Op, record::ops::Checkpoint>)
        if (op.tick >= tick) return;
      if constexpr (!std::is_same_v<Op, record::ops::End>) writer.add(op);
    });
    writer.close_chunk();
  }
  writer.sync();
  return cut;
}

}  // namespace ream::test
