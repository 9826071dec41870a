#include "record/ops.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "support/example_log.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"

namespace ream::record::ops {
namespace {

using test::example_op;
using test::expect_error;

template <typename Op>
std::vector<Op> read_back(const Bytes& raw) {
  std::vector<Op> found;
  read(raw, newest_revision, [&](const Op& op) { found.push_back(op); });
  return found;
}

template <typename Op>
void expect_back() {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    Bytes raw;
    put(raw, example_op<Op>(seed));
    EXPECT_EQ(read_back<Op>(raw), std::vector{example_op<Op>(seed)}) << Op::name << " " << seed;
  }
}

TEST(Ops, EveryOpComesBack) {
  int kinds = 0;
  for (int code = 0; code < 256; ++code)
    with_op(static_cast<uint8_t>(code), [&]<typename Op>() {
      EXPECT_EQ(code, Op::code);
      expect_back<Op>();
      ++kinds;
    });
  EXPECT_EQ(kinds, 8);
}

TEST(Ops, FieldsLieInTheFileAsTheManifestSays) {
  Checkpoint checkpoint;
  checkpoint.tick = 0x01020304;
  checkpoint.session_hash = 0x1112131415161718;
  checkpoint.grid_hash = 0x2122232425262728;
  Bytes raw;
  put(raw, checkpoint);
  const std::vector<int> expected = {5,    20,   0,    0,    0,    0x04, 0x03, 0x02, 0x01,
                                     0x18, 0x17, 0x16, 0x15, 0x14, 0x13, 0x12, 0x11, 0x28,
                                     0x27, 0x26, 0x25, 0x24, 0x23, 0x22, 0x21};
  ASSERT_EQ(raw.size(), expected.size());
  for (size_t i = 0; i < raw.size(); ++i) EXPECT_EQ(std::to_integer<int>(raw[i]), expected[i]) << i;
}

TEST(Ops, FloatsKeepEveryBit) {
  const std::vector<uint32_t> patterns = {0,          0x80000000, 1,          0x7f800000,
                                          0xff800000, 0x7fc00000, 0x7f800001, 0xffffffff};
  std::vector<Tick> rows(patterns.size());
  for (size_t i = 0; i < rows.size(); ++i) rows[i].thrust_n = std::bit_cast<float>(patterns[i]);
  Bytes raw;
  put_rows(raw, rows);
  const auto back = read_back<Tick>(raw);
  ASSERT_EQ(back.size(), rows.size());
  for (size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(std::bit_cast<uint32_t>(back[i].thrust_n), patterns[i]);
}

TEST(Ops, AVisitorGetsOnlyWhatItTakes) {
  Bytes raw;
  put(raw, example_op<Header>(1));
  put_rows(raw, std::vector<Tick>{example_op<Tick>(1), example_op<Tick>(2)});
  put(raw, example_op<End>(3));
  EXPECT_EQ(read_back<Tick>(raw).size(), 2u);
  EXPECT_EQ(read_back<End>(raw), std::vector{example_op<End>(3)});
  EXPECT_TRUE(read_back<Bricks>(raw).empty());
}

TEST(Ops, UnknownCodesArePassedOver) {
  Bytes raw;
  const size_t begun = begin_op(raw, 200);
  raw.resize(raw.size() + 33);
  end_op(raw, begun);
  put(raw, example_op<End>(3));
  EXPECT_EQ(read_back<End>(raw), std::vector{example_op<End>(3)});
}

/// As the generator would make it from a manifest in which revision 3 added fields.
struct Grown {
  static constexpr uint8_t code = Event::code;
  static constexpr std::string_view name = "event";
  static constexpr bool columns = false;
  uint32_t tick = 0;
  uint32_t added = 0;
  std::string kind, words;
  template <typename Self, typename Visit>
  static constexpr void visit_fields(Self& self, Visit&& visit) {
    visit(self.tick, uint32_t{1});
    visit(self.added, uint32_t{3});
    visit(self.kind, uint32_t{1});
    visit(self.words, uint32_t{1});
  }
};

TEST(Ops, OfAnOlderRevisionHasOnlyTheFieldsOfItsTime) {
  Bytes old_raw, new_raw;
  const Grown op{5, 77, "fault", "words"};
  put(old_raw, op, 2);
  put(new_raw, op, 3);
  EXPECT_EQ(new_raw.size(), old_raw.size() + 4);
  const Event as_event{5, "fault", "words"};
  EXPECT_EQ(read_back<Event>(old_raw), std::vector{as_event});
}

TEST(Ops, BytesThatAnOpDoesNotFitAreRefused) {
  Bytes whole;
  put(whole, example_op<Annotation>(1));
  for (size_t size = 1; size < whole.size(); ++size) {
    const std::span<const std::byte> cut(whole.data(), size);
    expect_error(ErrorKind::invalid_input, "does not fit",
                 [&] { read(cut, newest_revision, [](const Annotation&) {}); });
  }
  Bytes longer = whole;
  longer.push_back({});
  longer[1] = static_cast<std::byte>(std::to_integer<int>(longer[1]) + 1);
  expect_error(ErrorKind::invalid_input, "annotation",
               [&] { read(longer, newest_revision, [](const Annotation&) {}); });
}

TEST(Ops, DamagedBytesNeverDoMoreThanBeRefused) {
  Bytes whole;
  put(whole, example_op<Header>(1));
  put_rows(whole, std::vector<Tick>{example_op<Tick>(1), example_op<Tick>(2)});
  put(whole, example_op<Bricks>(1));
  put(whole, example_op<Annotation>(1));
  std::mt19937 random(test::seed());
  int refused = 0;
  for (int round = 0; round < 20000; ++round) {
    Bytes raw = whole;
    for (auto k = 1 + random() % 4; k > 0; --k) raw[random() % raw.size()] = static_cast<std::byte>(random());
    if (random() % 4 == 0) raw.resize(random() % raw.size());
    try {
      read(raw, newest_revision, [](const auto&) {});
    } catch (const Error& error) {
      ASSERT_EQ(error.kind(), ErrorKind::invalid_input);
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace ream::record::ops
