#include "e2e/cli/command_line.hpp"
#include "store/zip_archive.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;

class ZippedCt : public CommandLine {
 protected:
  void zip(const std::string& name, const std::vector<std::pair<std::string, std::string>>& files) {
    std::vector<store::ArchiveEntry> entries;
    for (const auto& [inside, bytes] : files)
      entries.push_back({write("plain/" + std::to_string(entries.size()), bytes), inside});
    store::write_zip(folder() / name, entries);
  }
};

TEST_F(ZippedCt, IsImportedAsItsFolderIs) {
  succeed({"phantom", "--out", "ct", "--spacing-mm", "1.5", "--format", "dicom"});
  std::vector<store::ArchiveEntry> entries;
  for (const auto& file : fs::directory_iterator(folder() / "ct"))
    if (file.path().extension() == ".dcm")
      entries.push_back({file.path(), "scan/" + file.path().filename().string()});
  store::write_zip(folder() / "ct.zip", entries);
  const auto plain = answer({"import", "ct", "--out", "plain-case", "--side", "right"});
  const auto zipped = answer({"import", "ct.zip", "--out", "zipped-case", "--side", "right"});
  EXPECT_EQ(zipped.at("bone_voxels"), plain.at("bone_voxels"));
  EXPECT_EQ(zipped.at("dims"), plain.at("dims"));
  EXPECT_EQ(zipped.at("warnings"), plain.at("warnings"));
}

TEST_F(ZippedCt, BadArchivesGetOneLine) {
  const auto refused = [&](const std::string& why) { refuse(1, why, {"import", "ct.zip", "--out", "a"}); };
  zip("ct.zip", {{"ct.nrrd", std::string(size_t{80} << 20, '\0')}});
  refused("ct.zip: 'ct.nrrd' in it is larger");
  zip("ct.zip", {{"../../evil.dcm", "x"}});
  refused("leads out of the archive");
  zip("ct.zip", {{"inner.zip", "x"}});
  refused("ct.zip holds another archive");
  zip("ct.zip", {{"notes.doc", "x"}});
  refused("ct.zip holds no CT");
  zip("ct.zip", {{"slice.dcm", "x"}});
  refused("ct.zip/slice.dcm is cut short or not DICOM");
  write("ct.zip", text_of("ct.zip").substr(0, 40));
  refused("ct.zip is not a valid zip archive");
}

TEST_F(ZippedCt, LyingHeadersGetOneLine) {
  const std::string head = "NRRD0004\ntype: short\ndimension: 3\nspace: LPS\nsizes: 1000 1000 1000000000\n";
  write("lying.nrrd", head + "space directions: (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\n\n1234");
  refuse(1, "lying.nrrd: its header claims 1e+15 voxels", {"import", "lying.nrrd", "--out", "a"});
  write("rows.txt", "0 0 0 1\n1 0 0 nan\n");
  refuse(1, "rows.txt line 2", {"import", "rows.txt", "--out", "a"});
  write("picture.nii", "\x89PNG\r\n\x1a\n" + std::string(1000, 'x'));
  refuse(1, "picture.nii", {"import", "picture.nii", "--out", "a"});
}

}  // namespace
}  // namespace ream::test
