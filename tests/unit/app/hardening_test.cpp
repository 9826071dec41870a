// What the compiler and the linker were told, looked for in the programs as they were built: the server, what
// reads strangers' files for it, and what draws.
#include <elf.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string_view>

#include "core/file.hpp"
#include "support/places.hpp"

namespace ream::test {
namespace {

/// A 64-bit ELF file, as far as it is of interest here.
class Elf {
 public:
  explicit Elf(const std::filesystem::path& path) : bytes_(read_text_file(path)) {
    const auto head = at<Elf64_Ehdr>(0);
    if (std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0)
      throw std::runtime_error(path.string() + " is no ELF file");
    type_ = head.e_type;
    for (int i = 0; i < head.e_phnum; ++i)
      segments_.push_back(at<Elf64_Phdr>(head.e_phoff + static_cast<uint64_t>(i) * head.e_phentsize));
    for (int i = 0; i < head.e_shnum; ++i)
      sections_.push_back(at<Elf64_Shdr>(head.e_shoff + static_cast<uint64_t>(i) * head.e_shentsize));
    names_ = contents(sections_.at(head.e_shstrndx));
  }

  uint16_t type() const { return type_; }
  const Elf64_Phdr* segment(uint32_t kind) const {
    const auto found =
        std::find_if(segments_.begin(), segments_.end(), [&](const auto& s) { return s.p_type == kind; });
    return found == segments_.end() ? nullptr : &*found;
  }
  std::string_view section(std::string_view name) const {
    for (const Elf64_Shdr& section : sections_)
      if (std::string_view(names_.data() + section.sh_name) == name) return contents(section);
    return {};
  }
  /// Bits of all entries of that kind in the dynamic section.
  uint64_t dynamic(int64_t tag) const {
    uint64_t value = 0;
    const std::string_view entries = section(".dynamic");
    for (size_t i = 0; i + sizeof(Elf64_Dyn) <= entries.size(); i += sizeof(Elf64_Dyn)) {
      Elf64_Dyn entry{};
      std::memcpy(&entry, entries.data() + i, sizeof entry);
      if (entry.d_tag == tag) value |= entry.d_un.d_val;
    }
    return value;
  }
  /// Whether it asks the libraries for a function whose name ends so.
  bool needs(std::string_view ending) const {
    const std::string_view names = section(".dynstr");
    for (size_t begin = 0; begin < names.size();) {
      const std::string_view name(names.data() + begin);
      if (name.ends_with(ending)) return true;
      begin += name.size() + 1;
    }
    return false;
  }
  size_t count_in_code(std::string_view bytes) const {
    const std::string_view code = section(".text");
    size_t count = 0;
    for (size_t at = code.find(bytes); at != std::string_view::npos; at = code.find(bytes, at + 1)) ++count;
    return count;
  }

 private:
  template <typename T>
  T at(uint64_t offset) const {
    T value{};
    std::memcpy(&value, std::string_view(bytes_).substr(offset, sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view contents(const Elf64_Shdr& section) const {
    return section.sh_type == SHT_NOBITS
               ? std::string_view()
               : std::string_view(bytes_).substr(section.sh_offset, section.sh_size);
  }

  const std::string bytes_;
  uint16_t type_ = 0;
  std::vector<Elf64_Phdr> segments_;
  std::vector<Elf64_Shdr> sections_;
  std::string_view names_;
};

class Hardening : public testing::TestWithParam<const char*> {
 protected:
  const Elf program_{build_folder() + "/" + GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Programs, Hardening, testing::Values("ream", "ream-reader", "ream-renderer"),
                         [](const auto& program) {
                           std::string name = program.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(Hardening, TheProgramLiesAnywhereAndNothingOfItIsBothWrittenAndRun) {
  EXPECT_EQ(program_.type(), ET_DYN);
  EXPECT_TRUE(program_.dynamic(DT_FLAGS_1) & DF_1_PIE);
  const Elf64_Phdr* stack = program_.segment(PT_GNU_STACK);
  ASSERT_NE(stack, nullptr);
  EXPECT_FALSE(stack->p_flags & PF_X);
}

TEST_P(Hardening, AddressesOfFunctionsAreFoundAtTheStartAndNotWrittenAgain) {
  EXPECT_NE(program_.segment(PT_GNU_RELRO), nullptr);
  EXPECT_TRUE((program_.dynamic(DT_FLAGS) & DF_BIND_NOW) || (program_.dynamic(DT_FLAGS_1) & DF_1_NOW));
}

TEST_P(Hardening, StacksAndBuffersAreChecked) {
  EXPECT_TRUE(program_.needs("__stack_chk_fail")) << "-fstack-protector-strong";
  EXPECT_TRUE(program_.needs("_chk")) << "memcpy and its kin: -D_FORTIFY_SOURCE=2";
}

TEST_P(Hardening, ContainersAreChecked) {
  EXPECT_TRUE(program_.needs("__glibcxx_assert_failPKciS0_S0_")) << "-D_GLIBCXX_ASSERTIONS";
}

#if defined(__x86_64__)
TEST_P(Hardening, StacksGrowPageByPageAndJumpsHaveTheirTargets) {
  constexpr std::string_view touch{"\x48\x83\x0c\x24\x00", 5};  // or qword [rsp], 0
  EXPECT_GT(program_.count_in_code(touch), 0u) << "-fstack-clash-protection";
  constexpr std::string_view target{"\xf3\x0f\x1e\xfa", 4};  // endbr64
  EXPECT_GT(program_.count_in_code(target), 1000u) << "-fcf-protection";
}
#endif

}  // namespace
}  // namespace ream::test
