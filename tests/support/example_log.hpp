#pragma once
#include <bit>
#include <filesystem>
#include <vector>

#include "core/hash.hpp"
#include "record/op_log.hpp"

namespace ream::test {

/// Every field that `revision` has gets a value of its own that depends on `seed` and its place only: the
/// same on every machine.
template <typename Op>
Op example_op(uint64_t seed, uint32_t revision = record::ops::newest_revision) {
  Op op;
  uint64_t place = 0;
  const auto number = [&] { return hash_combine(hash_combine(seed, Op::code), place); };
  Op::visit_fields(op, [&]<typename Field>(Field& field, uint32_t since) {
    if (since > revision) return;
    ++place;
    if constexpr (std::is_same_v<Field, std::string>)
      field = "text " + to_hex(number());
    else if constexpr (std::is_same_v<Field, record::ops::Bytes>)
      field.assign(number() % 40, static_cast<std::byte>(place));
    else if constexpr (std::is_same_v<Field, QuantisedPose>)
      for (int32_t k = 0; k < 12; ++k)
        (k < 9 ? field.rotation_q30[k] : field.translation_nm[k - 9]) =
            static_cast<int32_t>(number() + 1000u * k);
    else if constexpr (std::is_floating_point_v<Field>)
      field = static_cast<Field>(static_cast<int64_t>(number() % 2000001) - 1000000) / Field{1024};
    else
      field = static_cast<Field>(number());
  });
  return op;
}

/// Like a hand at work: poses creep, flags and most figures change now and then, the hash always.
inline record::ops::Tick example_tick(uint32_t tick, uint32_t revision = record::ops::newest_revision) {
  auto row = example_op<record::ops::Tick>(1 + tick / 40, revision);
  const auto creep = static_cast<int32_t>(tick % 40);
  for (QuantisedPose* pose : {&row.world_from_handle, &row.grid_from_tool})
    for (int32_t& nm : pose->translation_nm) nm = nm / 4 + 25 * creep;
  row.tick = tick;
  row.flags &= 63;
  row.session_hash = mix64(tick);
  return row;
}

/// A chunk as the recorder makes them: the rows, bricks (a key if asked for) and a checkpoint.
inline void add_example_chunk(record::OpLogWriter& log, uint32_t first_tick, uint32_t ticks, bool key) {
  namespace ops = record::ops;
  for (uint32_t tick = first_tick; tick < first_tick + ticks; ++tick) log.add(example_tick(tick));
  auto bricks = example_op<ops::Bricks>(first_tick);
  bricks.key = key ? 1 : 0;
  log.add(bricks);
  log.add(example_op<ops::Checkpoint>(first_tick));
}

/// A small session with every op in it, closed in order.
inline void write_example_log(std::unique_ptr<record::LogSink> sink) {
  namespace ops = record::ops;
  record::OpLogWriter log(std::move(sink));
  log.add(example_op<ops::Header>(7));
  log.add(example_op<ops::Segment>(7));
  add_example_chunk(log, 0, 50, true);
  log.close_chunk();
  log.add(example_op<ops::Event>(7));
  add_example_chunk(log, 50, 50, false);
  log.close_chunk();
  log.add(example_op<ops::Annotation>(7));
  log.close_chunk();
  add_example_chunk(log, 100, 30, true);
  log.add(example_op<ops::End>(7));
  log.close_chunk();
  log.sync();
}

/// All ops of a log in order, each as its bytes in the newest revision, so that logs can be compared.
inline std::vector<record::ops::Bytes> ops_in(const record::OpLogReader& log) {
  std::vector<record::ops::Bytes> found;
  for (size_t i = 0; i < log.chunks().size(); ++i)
    record::ops::read(log.read_chunk(i), log.revision(), [&](const auto& op) {
      found.emplace_back();
      record::ops::put(found.back(), op);
    });
  return found;
}

/// All ops of one kind.
template <typename Op>
std::vector<Op> all_of(const record::OpLogReader& log) {
  std::vector<Op> found;
  for (size_t i = 0; i < log.chunks().size(); ++i)
    record::ops::read(log.read_chunk(i), log.revision(), [&](const Op& op) { found.push_back(op); });
  return found;
}

}  // namespace ream::test
