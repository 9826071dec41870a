// What only the header's check stands against where the kernel closes nothing off: a name of another file
// that this program reads over and the library does not.
#include "reader/volume_header.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::reader {
namespace {

const std::string meta_fields =
    "ObjectType = Image\nNDims = 3\nBinaryData = True\nCompressedData = False\nElementSpacing = 1 1 1\n"
    "DimSize = 4 4 4\nElementType = MET_SHORT\n";
const std::string nrrd_fields =
    "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 4 4\n"
    "space directions: (1,0,0) (0,1,0) (0,0,1)\nendian: little\nencoding: raw\n";
const std::string voxels(128, '\0');

class HeaderOfAVolume : public testing::Test {
 protected:
  HeaderOfAVolume() { folder_.write("other.raw", std::string(128, 'x')); }
  std::filesystem::path written(const std::string& name, const std::string& text) {
    return folder_.write(name, text + voxels);
  }
  void refuse(const std::string& mentioned, const std::string& name, const std::string& text) {
    SCOPED_TRACE(text.substr(0, 300));
    test::expect_error(ErrorKind::invalid_input, mentioned,
                       [&] { VolumeHeader header(written(name, text)); });
  }

  test::TemporaryFolder folder_;
};

TEST_F(HeaderOfAVolume, OfAMetaImageHasLinesOfOneKeyAndOneValue) {
  EXPECT_NO_THROW(VolumeHeader(written("a.mha", meta_fields + "ElementDataFile = LOCAL\n")));
  EXPECT_NO_THROW(VolumeHeader(
      written("a.mha", "Comment = scanned at 10:30\n\n" + meta_fields + "ElementDataFile = LOCAL\r\n")));
  const std::string local = "ElementDataFile = LOCAL\n", file = "/etc/hostname";
  refuse("no 'key = value'", "a.mha", meta_fields + "ElementDataFile : " + file + "\n" + local);
  refuse("no 'key = value'", "a.mha", meta_fields + "ElementDataFile : " + file + " = x\n" + local);
  refuse("no 'key = value'", "a.mha", meta_fields + "Comment\n" + local);
  refuse("control", "a.mha", meta_fields + "Comment = a\rElementDataFile = " + file + "\n" + local);
  refuse("control", "a.mha", meta_fields + "Comment = a" + std::string(1, '\0') + "\n" + local);
  refuse("too long", "a.mha",
         meta_fields + "Comment = " + std::string(500, ' ') + "ElementDataFile = " + file + "\n" + local);
  refuse("no 'key = value'", "a.mha", meta_fields + std::string(100, 'k') + " = 1\n" + local);
}

TEST_F(HeaderOfAVolume, OfANrrdNamesItsVoxelsInOneWay) {
  EXPECT_NO_THROW(VolumeHeader(written("a.nrrd", nrrd_fields + "# which data file this was\n\n")));
  refuse("control", "a.nrrd", nrrd_fields + "content: a\rdata file: /etc/hostname\n\n");
  refuse("may name another file", "a.nrrd", nrrd_fields + "data file\n\n");
  refuse("no end", "a.nrrd",
         nrrd_fields + std::string(size_t{4} << 20, '#') + "\ndata file: /etc/hostname\n\n");
  std::string comments;
  while (comments.size() < size_t{4} << 20) comments += "# one of very many lines\n";
  refuse("no end", "a.nrrd", nrrd_fields + comments + "data file: /etc/hostname\n\n");
}

TEST_F(HeaderOfAVolume, ALinkIsNoFileOfVoxels) {
  std::filesystem::create_symlink("other.raw", folder_.path() / "link.raw");
  EXPECT_NO_THROW(VolumeHeader(folder_.write("a.mhd", meta_fields + "ElementDataFile = other.raw\n")));
  test::expect_error(ErrorKind::invalid_input, "the link link.raw", [&] {
    VolumeHeader header(folder_.write("a.mhd", meta_fields + "ElementDataFile = link.raw\n"));
  });
}

TEST_F(HeaderOfAVolume, NamesTheFileOfItsVoxels) {
  EXPECT_EQ(voxel_file_named_in(written("a.mhd", meta_fields + "ElementDataFile = a b.raw\n")), "a b.raw");
  EXPECT_EQ(voxel_file_named_in(written("a.mha", meta_fields + "ElementDataFile = Local\n")), "");
  EXPECT_EQ(voxel_file_named_in(written("a.nhdr", nrrd_fields + "Data File: a.raw\n\n")), "a.raw");
  EXPECT_EQ(voxel_file_named_in(written("a.nrrd", nrrd_fields + "\n")), "");
}

TEST_F(HeaderOfAVolume, NamesAreInAnyCase) {
  EXPECT_NO_THROW(VolumeHeader(written("A.MHA", meta_fields + "ElementDataFile = LOCAL\n")));
  refuse("no NIfTI", "A.NII", std::string(400, 'x'));
}

}  // namespace
}  // namespace ream::reader
