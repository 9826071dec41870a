#include "fe/materials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>

#include "core/error.hpp"
#include "core/thread_pool.hpp"
#include "fe/number_text.hpp"

namespace ream::fe {

double ModulusLaw::modulus_mpa(double gray) const {
  return a_mpa + b * (c == 1.0 ? gray : std::pow(gray, c));
}

std::string ModulusLaw::description() const {
  return name + ": E = " + real_text(a_mpa) + " + " + real_text(b) + " g" +
         (c == 1.0 ? "" : "^" + real_text(c)) + " MPa";
}

ModulusLaw linear_law(double a_mpa, double b) { return {"linear", a_mpa, b, 1.0}; }
ModulusLaw power_law(double a_mpa, double b, double c) { return {"power", a_mpa, b, c}; }

std::span<const NamedLaw> named_laws() {
  static const std::array<NamedLaw, 4> laws{{
      {{"morgan-2003", 0.0, 8920.0, 1.83}, true, "Morgan, Bayraktar, Keaveny 2003, sites pooled"},
      {{"morgan-2003-femoral-neck", 0.0, 6850.0, 1.49}, true, "Morgan, Bayraktar, Keaveny 2003"},
      {{"buechler-2002", 0.0, 15000.0 / (1.8 * 1.8), 2.0},
       true,
       "Buechler et al. 2002, scapula: 15 GPa (rho / 1.8)^2"},
      {{"ciclope", 0.0, 18000.0 / std::pow(250.0, 2.5), 2.5},
       false,
       "ciclope's example for 8-bit micro-CT: 18 GPa (g / 250)^2.5"},
  }};
  return laws;
}

const NamedLaw& law_of_name(const std::string& name) {
  const auto laws = named_laws();
  const auto found =
      std::find_if(laws.begin(), laws.end(), [&](const NamedLaw& l) { return l.law.name == name; });
  if (found != laws.end()) return *found;
  std::string names;
  for (const NamedLaw& law : laws) names += (names.empty() ? "" : ", ") + law.law.name;
  throw Error(ErrorKind::usage, "--law '" + name + "' is none of " + names);
}

const NamedLaw& default_density_law() { return named_laws()[0]; }

namespace {

constexpr size_t block_rows = size_t{1} << 20;

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
                  " elements) would have E = " + real_text(modulus_mpa) + " MPa by the law " +
                  law.description() +
                  "; E must be positive: give another --modulus, or a higher --threshold");
}

}  // namespace

CodeHistogram histogram_of(const ElementCodes& codes) {
  CodeHistogram sum(code_count);
  std::mutex mutex;
  const uint64_t blocks = (codes.size() + block_rows - 1) / block_rows;
  parallel_for(2, std::min<uint64_t>(blocks, 2), [&](size_t part) {
    CodeHistogram own(code_count);
    std::vector<uint16_t> scratch;
    for (uint64_t i = part; i < blocks; i += 2) {
      const size_t count = std::min<uint64_t>(block_rows, codes.size() - i * block_rows);
      for (const uint16_t code : codes.read(i * block_rows, count, scratch)) ++own[code];
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

namespace {

/// Calls use(id, material) for the elements of one half of the mesh.
template <typename Use>
void for_each_of_half(const ElementCodes& codes, const Materials& materials, size_t half, Use&& use) {
  const uint64_t middle = codes.size() / 2;
  const uint64_t begin = half == 0 ? 0 : middle, end = half == 0 ? middle : codes.size();
  std::vector<uint16_t> scratch;
  for (uint64_t first = begin; first < end; first += block_rows) {
    uint64_t id = first + 1;
    for (const uint16_t code : codes.read(first, std::min<uint64_t>(block_rows, end - first), scratch))
      use(id++, materials.of_code[code]);
  }
}

/// A material of more than the limit is a part of its own.
size_t end_of_part(const Materials& materials, size_t first, uint64_t max_ids) {
  uint64_t ids = 0;
  size_t end = first;
  while (end < materials.list.size() && (end == first || ids + materials.list[end].elements <= max_ids))
    ids += materials.list[end++].elements;
  return end;
}

}  // namespace

void for_each_part_of_sets(const ElementCodes& codes, const Materials& materials, MemoryBudget& budget,
                           const std::function<void(const SetsPart&)>& use) {
  const size_t count = materials.list.size();
  std::array<std::vector<uint64_t>, 2> places{std::vector<uint64_t>(count), std::vector<uint64_t>(count)};
  parallel_for(2, 2, [&](size_t half) {
    for_each_of_half(codes, materials, half, [&](uint64_t, uint32_t m) { ++places[half][m]; });
  });
  const std::vector<uint64_t> in_first_half = places[0];
  for (size_t first = 0; first < count;) {
    SetsPart part{first, end_of_part(materials, first, budget.left() / (2 * sizeof(uint32_t))), {}, {0}};
    for (size_t m = first; m < part.end_material; ++m) {
      places[0][m] = part.begins.back();
      places[1][m] = part.begins.back() + in_first_half[m];
      part.begins.push_back(part.begins.back() + materials.list[m].elements);
    }
    part.ids.resize(part.begins.back());
    const auto in_part = [&](size_t m) { return m >= first && m < part.end_material; };
    parallel_for(2, 2, [&](size_t half) {
      for_each_of_half(codes, materials, half, [&](uint64_t id, uint32_t m) {
        if (in_part(m)) part.ids[places[half][m]++] = static_cast<uint32_t>(id);
      });
    });
    use(part);
    first = part.end_material;
  }
}

}  // namespace ream::fe
