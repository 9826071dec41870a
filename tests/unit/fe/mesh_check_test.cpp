#include "fe/mesh_check.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "unit/fe/small_models.hpp"

namespace ream::fe::test {
namespace {

using ream::test::expect_error;

class MeshCheck : public testing::Test {
 protected:
  MeshCheck() : sound_(inp_of(model_of({3, 2, 2}, [](int u, int, int) { return 100 + 100 * (u % 2); }))) {}

  MeshFacts check(const std::string& text) {
    return check_mesh_file(folder_.write("mesh.inp", text), MeshFormat::inp, MemoryBudget());
  }
  /// The sound file with one piece replaced.
  std::string with(const std::string& from, const std::string& to) const {
    const size_t at = sound_.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return std::string(sound_).replace(at, from.size(), to);
  }
  void refuse(const std::string& mentioned, const std::string& from, const std::string& to) {
    expect_error(ErrorKind::invalid_input, mentioned, [&] { check(with(from, to)); });
  }

  std::string sound_;
  ream::test::TemporaryFolder folder_;
};

TEST_F(MeshCheck, ASoundFileIsMeasured) {
  const MeshFacts facts = check(sound_);
  EXPECT_EQ(facts.elements, 12u);
  EXPECT_EQ(facts.nodes, 36u);
  EXPECT_EQ(facts.materials, 2u);
  EXPECT_DOUBLE_EQ(facts.volume_mm3, 1.5);
  EXPECT_DOUBLE_EQ(facts.min_jacobian_mm3, 0.125);
}

TEST_F(MeshCheck, FindsWhatSolversRefuseAndWhatTheyPassOver) {
  refuse("node id 0", "\n1,0.0,0.0,0.0\n", "\n0,0.0,0.0,0.0\n");
  refuse("node 1 is given twice", "\n2,0.5", "\n1,0.5");
  refuse("node 40 belongs to no element", "*ELEMENT", "40,9.0,9.0,9.0\n*ELEMENT");
  refuse("given nowhere", "\n36,", "\n37,");
  refuse("has no eight nodes", "\n1,1,2,6,5,13,14,18,17\n", "\n1,1,2,6,5,13,14,18\n");
  refuse("twice", "\n1,1,2,6,5,13,14,18,17\n", "\n1,1,2,6,5,13,14,18,18\n");
  refuse("names node 0", "\n1,1,2,6,5,13,14,18,17\n", "\n1,0,2,6,5,13,14,18,17\n");
  refuse("Jacobian", "\n1,1,2,6,5,13,14,18,17\n", "\n1,13,14,18,17,1,2,6,5\n");
  refuse("Jacobian", "\n1,1,2,6,5,13,14,18,17\n", "\n1,1,2,5,6,13,14,17,18\n");
  refuse("element 1 is given twice", "\n2,2,3,7,6,14,15,19,18\n", "\n1,2,3,7,6,14,15,19,18\n");
  refuse("has no section", "*SOLID SECTION, ELSET=SET_2, MATERIAL=MAT_2\n", "");
  refuse("more than one section", "*SOLID SECTION, ELSET=SET_2", "*SOLID SECTION, ELSET=EALL");
  refuse("no element set", "*SOLID SECTION, ELSET=SET_2", "*SOLID SECTION, ELSET=SET_3");
  refuse("has no *ELASTIC", "MATERIAL=MAT_2", "MATERIAL=MAT_3");
  refuse("E > 0", "*ELASTIC\n100.0, 0.3", "*ELASTIC\n-100.0, 0.3");
  refuse("E > 0", "*ELASTIC\n100.0, 0.3", "*ELASTIC\n100.0, 0.5");
  refuse("C3D8", "TYPE=C3D8", "TYPE=C3D20");
  refuse("more than 16 ids", "*ELSET, ELSET=SET_1\n1,3,4,6,7,9,10,12\n",
         "*ELSET, ELSET=SET_1\n1,3,4,6,7,9,10,12,1,1,1,1,1,1,1,1,1\n");
}

TEST_F(MeshCheck, LooksAtFilesOfOtherMakersToo) {
  // Lower case, CR LF, blanks, the section by the elements' own set, nodes in any order.
  const std::string text =
      "*Heading\r\n*Node\r\n 8, 0., 2., 2.\r\n 1, 0, 0, 0\r\n 2, 2e0, 0, 0\r\n 3, 2, 2, 0\r\n 4, 0, 2, 0\r\n"
      " 5, 0, 0, 2\r\n 6, 2, 0, 2\r\n 7, 3, 2, 2\r\n*Element, type=C3D8, elset=All\r\n"
      " 10, 1, 2, 3, 4, 5, 6, 7, 8\r\n*Material, name=bone\r\n*Elastic\r\n 10., .3\r\n"
      "*Solid Section, elset=ALL, material=Bone\r\n";
  const MeshFacts facts = check(text);
  // One corner is drawn out by 1: its share of the volume is the integral of its shape function.
  EXPECT_NEAR(facts.volume_mm3, 9.0, 1e-12);
  EXPECT_GT(facts.min_jacobian_mm3, 0.0);
}

TEST_F(MeshCheck, VtuFilesAreCheckedByteForByte) {
  const auto path = folder_.path() / "mesh.vtu";
  MeshOptions options;
  options.check = true;
  MemoryBudget budget;
  make_mesh(model_of({3, 2, 2}, [](int u, int, int) { return 100 + 100 * (u % 2); }), options, budget, path);
  const std::string sound = read_text_file(path);
  const MeshFacts facts = check_mesh_file(path, MeshFormat::vtu, budget);
  EXPECT_EQ(facts.elements, 12u);
  EXPECT_EQ(facts.nodes, 36u);
  EXPECT_DOUBLE_EQ(facts.volume_mm3, 1.5);
  const size_t data = sound.find('_', sound.find("AppendedData")) + 1;
  const auto refuse_changed = [&](const std::string& mentioned, size_t at, char to) {
    std::string changed = sound;
    changed[at] = to;
    expect_error(ErrorKind::invalid_input, mentioned,
                 [&] { check_mesh_file(folder_.write("bad.vtu", changed), MeshFormat::vtu, budget); });
  };
  const size_t connectivity = data + 8 + 36 * 24 + 8, types = connectivity + 12 * 32 + 8 + 12 * 4 + 8;
  refuse_changed("names point", connectivity, 99);
  refuse_changed("twice", connectivity, 1);
  refuse_changed("hexahedron", types, 11);
  refuse_changed("wrong offset", connectivity + 12 * 32 + 8, 9);
  expect_error(ErrorKind::invalid_input, "cut short", [&] {
    check_mesh_file(folder_.write("bad.vtu", sound.substr(0, sound.size() - 100)), MeshFormat::vtu, budget);
  });
}

}  // namespace
}  // namespace ream::fe::test
