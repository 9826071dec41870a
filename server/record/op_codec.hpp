#pragma once
#include <type_traits>

#include "record/columns.hpp"
#include "record/ops.hpp"

namespace ream::record::ops {

/// Words of a row of Op in files of that revision.
template <typename Op>
uint32_t row_words(uint32_t revision) {
  uint32_t count = 0;
  const Op op{};
  Op::visit_fields(op, [&]<typename Field>(const Field&, uint32_t since) {
    if (since <= revision) count += words_of<Field>;
  });
  return count;
}

/// Appends the code and room for the length; end_op() fills that in.
size_t begin_op(Bytes& out, uint8_t code);
/// Error invalid_input when the op has become longer than 4 GiB.
void end_op(Bytes& out, size_t begun);
/// Error invalid_input naming the op, which does not fit its bytes.
[[noreturn]] void throw_misfit(std::string_view name);

/// Appends rows as columns: count of rows, then columns.hpp.
template <typename Op>
void put_rows(Bytes& out, std::span<const Op> rows, uint32_t revision = newest_revision) {
  static_assert(Op::columns);
  const uint32_t columns = row_words<Op>(revision);
  std::vector<uint32_t> words(rows.size() * columns);
  uint32_t* next = words.data();
  for (const Op& row : rows)
    Op::visit_fields(row, [&](const auto& field, uint32_t since) {
      if (since <= revision) put_words(next, field);
    });
  const size_t begun = begin_op(out, Op::code);
  put_field(out, static_cast<uint32_t>(rows.size()));
  put_columns(out, words, columns);
  end_op(out, begun);
}
inline void put_rows(Bytes& out, std::span<const Tick> rows) { put_rows<Tick>(out, rows); }

/// Appends an op as files of that revision have it.
template <typename Op>
void put(Bytes& out, const Op& op, uint32_t revision = newest_revision) {
  if constexpr (Op::columns) {
    put_rows<Op>(out, std::span(&op, 1), revision);
  } else {
    const size_t begun = begin_op(out, Op::code);
    Op::visit_fields(op, [&](const auto& field, uint32_t since) {
      if (since <= revision) put_field(out, field);
    });
    end_op(out, begun);
  }
}

template <typename Op, typename Visitor>
void read_rows(std::span<const std::byte> body, uint32_t revision, Visitor& visitor) {
  FieldReader in(body);
  uint32_t rows = 0;
  in.take(rows);
  const uint32_t columns = row_words<Op>(revision);
  std::vector<uint32_t> words;
  if (!in.fits() || !take_columns(in.rest(), rows, columns, words)) throw_misfit(Op::name);
  const uint32_t* next = words.data();
  for (uint32_t row = 0; row < rows; ++row) {
    Op op;
    Op::visit_fields(op, [&](auto& field, uint32_t since) {
      if (since <= revision) take_words(next, field);
    });
    visitor(std::as_const(op));
  }
}

/// Calls visitor(op) for each op in `raw` that it takes an argument of, rows one by one; every other op is
/// skipped unread. Fields that files of that revision lack are zero. Error invalid_input when an op does not
/// fit its bytes; those before it have been visited.
template <typename Visitor>
void read(std::span<const std::byte> raw, uint32_t revision, Visitor&& visitor) {
  FieldReader in(raw);
  while (!in.rest().empty()) {
    uint8_t code = 0;
    uint32_t size = 0;
    in.take(code);
    in.take(size);
    const std::span<const std::byte> body = in.take_bytes(size);
    if (!in.fits()) throw_misfit("code " + std::to_string(code));
    with_op(code, [&]<typename Op>() {
      if constexpr (std::is_invocable_v<Visitor&, const Op&>) {
        if constexpr (Op::columns) {
          read_rows<Op>(body, revision, visitor);
        } else {
          Op op;
          FieldReader fields(body);
          Op::visit_fields(op, [&](auto& field, uint32_t since) {
            if (since <= revision) fields.take(field);
          });
          if (!fields.fits() || !fields.rest().empty()) throw_misfit(Op::name);
          visitor(std::as_const(op));
        }
      }
    });
  }
}

}  // namespace ream::record::ops
