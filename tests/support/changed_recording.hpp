#pragma once
#include <filesystem>

#include "record/op_log.hpp"

namespace ream::test {

/// Writes a recording once more with every op (as a reference to a copy) given to `change`, chunk by chunk,
/// with checksums that fit: what somebody who means to deceive would write.
template <typename Change>
void change_recording(const std::filesystem::path& from, const std::filesystem::path& to, Change change) {
  const record::OpLogReader reader(from);
  record::OpLogWriter writer(record::create_log_file(to));
  for (size_t i = 0; i < reader.chunks().size(); ++i) {
    record::ops::read(reader.read_chunk(i), reader.revision(), [&](const auto& op) {
      auto copy = op;
      change(copy);
      writer.add(copy);
    });
    writer.close_chunk();
  }
  writer.sync();
}

/// A change of one kind of op.
template <typename Op, typename Change>
auto of(Change change) {
  return [change](auto& op) {
    if constexpr (std::is_same_v<std::remove_reference_t<decltype(op)>, Op>) change(op);
  };
}

}  // namespace ream::test
