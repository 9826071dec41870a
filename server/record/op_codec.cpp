#include "record/op_codec.hpp"

#include <limits>

#include "core/error.hpp"

namespace ream::record::ops {

size_t begin_op(Bytes& out, uint8_t code) {
  put_field(out, code);
  put_field(out, uint32_t{0});
  return out.size();
}

void end_op(Bytes& out, size_t begun) {
  const size_t size = out.size() - begun;
  if (size > std::numeric_limits<uint32_t>::max())
    throw Error(ErrorKind::invalid_input, "an op of a recording would be longer than 4 GiB");
  for (size_t k = 0; k < 4; ++k) out[begun - 4 + k] = static_cast<std::byte>(size >> (8 * k));
}

void throw_misfit(std::string_view name) {
  throw Error(ErrorKind::invalid_input, "an op of a recording (" + std::string(name) +
                                            ") does not fit its length; a faulty program wrote it");
}

}  // namespace ream::record::ops
