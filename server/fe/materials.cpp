#include "fe/materials.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "core/error.hpp"
#include "fe/number_text.hpp"
#include "fe/two_threads.hpp"

namespace ream::fe {
namespace {

constexpr size_t block = size_t{1} << 20;

void check(const MaterialRule& rule) {
  if (!(rule.poisson > -1.0 && rule.poisson < 0.5))
    throw Error(ErrorKind::usage,
                "Poisson's ratio " + real_text(rule.poisson) + " must lie between -1 and 0.5");
  if (rule.bin_width_mpa && !(*rule.bin_width_mpa > 0.0))
    throw Error(ErrorKind::usage, "the width of bins must be a positive number of MPa");
}

[[noreturn]] void refuse(double modulus_mpa, double gray, uint64_t elements, const ModulusLaw& law) {
  throw Error(ErrorKind::invalid_input,
              "gray value " + real_text(gray) + " (" + std::to_string(elements) +
                  " elements) would have E = " + real_text(modulus_mpa) + " MPa by the law " + law.words() +
                  "; E must be positive: give another --modulus, or a higher --threshold");
}

}  // namespace

CodeHistogram histogram_of(const ElementCodes& codes) {
  CodeHistogram sum(code_count);
  std::mutex mutex;
  const uint64_t blocks = (codes.size() + block - 1) / block;
  on_two_threads(std::min<uint64_t>(blocks, 2), [&](size_t part) {
    CodeHistogram own(code_count);
    std::vector<uint16_t> scratch;
    for (uint64_t i = part; i < blocks; i += 2) {
      const size_t count = std::min<uint64_t>(block, codes.size() - i * block);
      for (const uint16_t code : codes.read(i * block, count, scratch)) ++own[code];
    }
    const std::lock_guard lock(mutex);
    for (size_t code = 0; code < code_count; ++code) sum[code] += own[code];
  });
  return sum;
}

Materials make_materials(const CodeHistogram& histogram, const voxel::GrayScale& gray,
                         const MaterialRule& rule) {
  check(rule);
  struct Bin {
    double modulus_sum = 0.0;
    uint64_t elements = 0;
    std::vector<uint16_t> codes;
  };
  std::map<double, Bin> bins;  // by modulus, or by the number of the bin
  for (size_t code = 0; code < code_count; ++code) {
    if (histogram[code] == 0) continue;
    const double value = gray.value(static_cast<double>(code)), e = rule.law.modulus_mpa(value);
    if (!(e > 0.0) || !std::isfinite(e)) refuse(e, value, histogram[code], rule.law);
    Bin& bin = bins[rule.bin_width_mpa ? std::floor(e / *rule.bin_width_mpa) : e];
    bin.modulus_sum += e * static_cast<double>(histogram[code]);
    bin.elements += histogram[code];
    bin.codes.push_back(static_cast<uint16_t>(code));
  }
  Materials materials;
  materials.of_code.resize(code_count);
  for (const auto& [key, bin] : bins) {
    double modulus = key;
    if (rule.bin_width_mpa)
      modulus = rule.bin_value == BinValue::centre ? (key + 0.5) * *rule.bin_width_mpa
                                                   : bin.modulus_sum / static_cast<double>(bin.elements);
    for (const uint16_t code : bin.codes)
      materials.of_code[code] = static_cast<uint32_t>(materials.list.size());
    materials.list.push_back({modulus, bin.elements});
  }
  return materials;
}

}  // namespace ream::fe
