#include <signal.h>
#include <zlib.h>

#include <fstream>

#include "case/landmarks.hpp"
#include "core/file.hpp"
#include "ct/phantom/phantom.hpp"
#include "ct/read/write_volume.hpp"
#include "e2e/cli/serve_fixture.hpp"
#include "support/identifier_search.hpp"
#include "support/twin/review_parts.hpp"
#include "unit/reader/changed_dicom.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

void append(std::string& bytes, uint64_t number, int count) {
  for (int k = 0; k < count; ++k) bytes += static_cast<char>(number >> (8 * k) & 0xff);
}

/// A plain zip archive, with a comment of its own and of every file, and an extra field that nobody knows.
std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files, const std::string& comment,
                   const std::string& file_comment, const std::string& extra_text) {
  std::string zip, directory, extra;
  append(extra, 0x7a7a, 2);
  append(extra, extra_text.size(), 2);
  extra += extra_text;
  for (const auto& [name, bytes] : files) {
    const uint64_t begin = zip.size();
    const auto crc =
        ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size()));
    std::string common;  // from the version needed to the length of the extra field
    append(common, 20, 2);
    append(common, 0, 4);
    append(common, 0x21 << 16, 4);
    append(common, crc, 4);
    append(common, bytes.size(), 4);
    append(common, bytes.size(), 4);
    append(common, name.size(), 2);
    append(common, extra.size(), 2);
    zip += "PK\x03\x04" + common + name + extra + bytes;
    directory += "PK\x01\x02";
    append(directory, 20, 2);
    directory += common;
    append(directory, file_comment.size(), 2);
    append(directory, 0, 8);
    append(directory, begin, 4);
    directory += name + extra + file_comment;
  }
  std::string end = "PK\x05\x06";
  append(end, 0, 4);
  append(end, files.size(), 2);
  append(end, files.size(), 2);
  append(end, directory.size(), 4);
  append(end, zip.size(), 4);
  append(end, comment.size(), 2);
  return zip + directory + end + comment;
}

/// CTs full of words that tell whose they are go through everything that the server does; then all that it
/// keeps and says is searched for them.
class Deidentification : public Serve {
 protected:
  Deidentification() {
    ct::PhantomParams params;
    params.spacing_mm = Vec3::Constant(2.0);
    phantom_ = ct::make_phantom(params);
  }

  /// A word that is nowhere else.
  std::string planted(const std::string& what, const std::string& word) {
    identifiers_.add(what, word);
    return word;
  }

  std::string dicom_zip();
  std::string volume_file(const std::string& ending);
  std::string nrrd();
  std::string nifti();
  std::string meta_image();

  /// What the server answers is kept to be searched.
  json ask(int status, const std::string& method, const std::string& target, const json& body = nullptr) {
    const HttpReply reply = http_request(port_, method, target, body.is_null() ? "" : body.dump());
    EXPECT_EQ(reply.status, status) << method << ' ' << target << '\n' << reply.body;
    for (const auto& [name, value] : reply.headers) answers_ += name + ": " + value + '\n';
    answers_ += reply.body + '\n';
    return json::parse(reply.body, nullptr, false);
  }
  json ended(json job) {
    while (job.at("state") == "waiting" || job.at("state") == "running") {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      job = json::parse(http_request(port_, "GET", "/api/v1/jobs/" + job.at("id").get<std::string>()).body);
    }
    return job;
  }
  json done(const json& job) {
    json last = ended(job);
    EXPECT_EQ(last.at("state"), "done") << last;
    answers_ += last.dump() + '\n';
    return last;
  }
  /// As the page does it; only its sender is told the file's name.
  json import(const std::string& file_name, const std::string& bytes, const json& more = json::object()) {
    const HttpReply begun = http_request(port_, "POST", "/api/v1/uploads",
                                         json{{"name", file_name}, {"bytes", bytes.size()}}.dump(),
                                         {{"Idempotency-Key", "upload-" + std::to_string(++uploads_)}});
    EXPECT_EQ(begun.status, 201) << begun.body;
    const std::string id = json::parse(begun.body, nullptr, false).value("id", "");
    constexpr size_t most_bytes = 1 << 20;
    for (size_t at = 0; at < bytes.size(); at += most_bytes)
      EXPECT_EQ(http_request(port_, "PUT", "/api/v1/uploads/" + id + "?offset=" + std::to_string(at),
                             bytes.substr(at, most_bytes), {{"Content-Type", "application/octet-stream"}})
                    .status,
                200);
    json wanted{{"upload_id", id}, {"side", "right"}};
    wanted.update(more);
    const HttpReply reply = http_request(port_, "POST", "/api/v1/cases", wanted.dump(),
                                         {{"Idempotency-Key", "case-" + std::to_string(uploads_)}});
    EXPECT_EQ(reply.status, 202) << reply.body;
    return ended(json::parse(reply.body));
  }
  std::string imported(const std::string& file_name, const std::string& bytes, const std::string& name) {
    const json job = import(file_name, bytes, {{"name", name}});
    EXPECT_EQ(job.at("state"), "done") << job;
    answers_ += job.dump() + '\n';
    std::string id = job.at("case_id");
    ask(200, "GET", "/api/v1/cases/" + id);
    answers_ += http_request(port_, "GET", "/api/v1/cases/" + id + "/volume").body + '\n';
    return id;
  }

  void make_ready(const std::string& id);
  std::string run_session(const std::string& id);
  void export_all(const std::string& session);
  void ask_everything();
  void expect_nothing(const std::string& place, const std::vector<std::string>& findings) {
    EXPECT_EQ(findings, std::vector<std::string>{}) << place;
  }
  void use_commands();

  /// What whoever imports the slices is told.
  static constexpr const char* remarks[] = {"words are burnt into their pictures",
                                            "their values 'Houndsfield'; this was taken as HU"};
  ct::Phantom phantom_;
  IdentifierSearch identifiers_;
  std::string answers_;
  int uploads_ = 0;
};

std::string Deidentification::dicom_zip() {
  const fs::path slices = folder() / "slices";
  fs::create_directories(slices);
  ct::write_dicom_folder(phantom_.volume, slices, 5);
  struct Tag {
    uint16_t group, element;
    const char *what, *word;
  };
  const Tag tags[] = {{0x0008, 0x0018, "instance UID", "1.2.840.90901.41.1"},
                      {0x0008, 0x0020, "study date", "1999.08.17"},
                      {0x0008, 0x0050, "accession number", "qaccession4711"},
                      {0x0008, 0x0080, "institution", "Zqhospital of St Mary"},
                      {0x0008, 0x0081, "institution's address", "Zqstreet 12"},
                      {0x0008, 0x0090, "referring physician", "Zqreferrer^Anna"},
                      {0x0008, 0x1010, "station", "zqstation3"},
                      {0x0008, 0x1030, "study description", "zqshoulder left study"},
                      {0x0008, 0x103e, "series description", "zqseries bone kernel"},
                      {0x0008, 0x1070, "operator", "Zqoperator^Paul"},
                      {0x0009, 0x0010, "private creator", "ZQPRIVATECREATOR"},
                      {0x0009, 0x1001, "private tag", "zqprivatevalue"},
                      {0x0010, 0x0010, "patient's name", "Zqpatient^J\xc3\xa4ne^Doe"},
                      {0x0010, 0x0020, "patient's id", "zqpid-0815"},
                      {0x0010, 0x0030, "birth date", "1941.03.17"},
                      {0x0010, 0x1040, "patient's address", "zqhome road 7"},
                      {0x0010, 0x4000, "comments", "zqcomment of the patient"},
                      {0x0018, 0x1000, "device serial", "zqserial99"},
                      {0x0018, 0x1030, "protocol", "zqprotocol"},
                      {0x0020, 0x000d, "study UID", "1.2.840.90902.42.1"},
                      {0x0020, 0x000e, "series UID", "1.2.840.90903.43.1"},
                      {0x0020, 0x0010, "study id", "zqstudyid5"},
                      {0x0020, 0x0052, "frame UID", "1.2.840.90904.44.1"},
                      {0x0020, 0x4000, "image comments", "zqimagecomment"},
                      {0x0032, 0x1060, "requested procedure", "zqprocedure"}};
  for (const Tag& tag : tags) planted(tag.what, tag.word);
  std::vector<std::pair<std::string, std::string>> files;
  const std::string inside = planted("folder in the archive", "zqfolder_doe") + "/";
  const std::string base = planted("file in the archive", "zqslicefile_doe");
  const std::string preamble = planted("preamble", "zqpreamble of the file");
  for (int w = 0; w < phantom_.volume.dims.z(); ++w) {
    const fs::path file = slice_file(slices, w + 1);
    change_dicom(file, [&](gdcm::DataSet& set) {
      for (const Tag& tag : tags)
        put_text(set, tag.group, tag.element,
                 tag.word + (tag.element == 0x0018 ? "." + std::to_string(w) : std::string()));
      put_text(set, 0x0028, 0x0301, "YES");
      put_text(set, 0x0028, 0x1054, "Houndsfield");
    });
    std::string bytes = read_text_file(file);
    bytes.replace(0, preamble.size(), preamble);
    files.emplace_back(inside + base + std::to_string(w) + ".dcm", bytes);
  }
  fs::remove_all(slices);
  return zip_of(files, planted("archive's comment", "zqzipcomment"),
                planted("file's comment", "zqentrycomment"),
                planted("archive's extra field", "zqextrafield"));
}

std::string Deidentification::volume_file(const std::string& ending) {
  const fs::path file = folder() / ("volume" + ending);
  ct::write_volume_file(phantom_.volume, file);
  std::string bytes = read_text_file(file);
  fs::remove(file);
  return bytes;
}

std::string Deidentification::nrrd() {
  std::string bytes = volume_file(".nrrd");
  bytes.insert(bytes.find('\n') + 1, "# " + planted("NRRD comment", "zqnrrdcomment") + "\ncontent: \"" +
                                         planted("NRRD content", "zqnrrdcontent") + "\"\n" +
                                         planted("NRRD key", "zqnrrdkey") +
                                         ":=" + planted("NRRD value", "zqnrrdvalue") + "\n");
  return bytes;
}

std::string Deidentification::nifti() {
  std::string bytes = volume_file(".nii");
  const auto put = [&](size_t at, const std::string& word) { bytes.replace(at, word.size(), word); };
  put(4, planted("NIfTI data_type", "zqdtype"));
  put(14, planted("NIfTI db_name", "zqdbname"));
  put(148, planted("NIfTI descrip", "zqdescrip of doe"));
  put(228, planted("NIfTI aux_file", "zqauxfile"));
  put(328, planted("NIfTI intent_name", "zqintent"));
  return bytes;
}

std::string Deidentification::meta_image() {
  std::string bytes = volume_file(".mha");
  bytes.insert(0, "Comment = " + planted("MetaImage comment", "zqmetacomment") +
                      "\nName = " + planted("MetaImage name", "zqmetaname") +
                      "\nPatientKey = " + planted("MetaImage key", "zqmetapatient") + "\n");
  return bytes;
}

void Deidentification::make_ready(const std::string& id) {
  const std::string at = "/api/v1/cases/" + id;
  done(ask(202, "POST", at + "/segmentation", json::object()));
  ask(200, "PUT", at + "/landmarks", case_::to_json(phantom_.truth.landmarks));
  json plan = ask(200, "POST", at + "/plan/proposal", {{"version_deg", 0}}).at("plan");
  std::erase_if(plan.get_ref<json::object_t&>(), [](const auto& entry) { return entry.second.is_null(); });
  ask(200, "PUT", at + "/plan", plan);
  done(ask(202, "POST", at + "/build", json::object()));
  ask(200, "GET", at);
  for (const char* part : {"/mesh", "/measures", "/plan", "/landmarks"})
    answers_ += http_request(port_, "GET", at + part).body + '\n';
}

std::string Deidentification::run_session(const std::string& id) {
  write("data/scripts/press.json",
        R"({"device": "hand", "duration_s": 600, "stiffness_n_mm": 100,
            "hand": {"start_mm": [0, 0, -1], "force_profile": [{"t_s": 0, "force_n": 40}]}})");
  std::string session = ask(201, "POST", "/api/v1/sessions", {{"case", id}, {"script", "press"}}).at("id");
  const std::string at = "/api/v1/sessions/" + session;
  ask(200, "POST", at + "/start");
  until("it has reamed a while",
        [&] { return request(200, "GET", at + "/metrics").at("duration_s").get<double>() > 1.0; });
  ask(200, "POST", at + "/stop");
  return session;
}

void Deidentification::export_all(const std::string& session) {
  write("web/review_file.html", "<!--ream:session-->");
  const std::string at = "/api/v1/sessions/" + session;
  for (const char* format :
       {"pdf", "html", "csv", "ply", "glb", "stl", "surface", "png", "zip", "causes", "review"}) {
    const json job = done(ask(202, "POST", at + "/exports", {{"format", format}}));
    const HttpReply file =
        http_request(port_, "GET", "/api/v1/jobs/" + job.at("id").get<std::string>() + "/result");
    EXPECT_EQ(file.status, 200) << format << ' ' << file.body.substr(0, 200);
    write(std::string("downloads/export.") + format, file.body);
    if (std::string_view(format) == "causes") write("downloads/causes.unpacked", gunzipped(file.body));
    if (std::string_view(format) != "review") continue;
    for (const char* id : {"ream-causes", "ream-review"})
      write(std::string("downloads/") + id, held_by(file.body, id));
  }
  for (const char* part : {"", "/session.json", "/metrics", "/score", "/events"})
    answers_ += http_request(port_, "GET", at + part).body + '\n';
  write("downloads/recording", http_request(port_, "GET", at + "/recording").body);
}

void Deidentification::ask_everything() {
  for (const char* list : {"cases", "sessions", "uploads", "audit?limit=200", "scores", "trash"})
    ask(200, "GET", std::string("/api/v1/") + list);
  answers_ += http_request(port_, "GET", "/metrics").body + '\n';
}

void Deidentification::use_commands() {
  const std::string zip = dicom_zip();
  write("given/ct.zip", zip);
  const Outcome out =
      succeed({"import", "given/ct.zip", "--out", "data/cases/by-command", "--side", "right"});
  for (const char* remark : remarks) EXPECT_NE(out.error.find(remark), std::string::npos) << out.error;
  answers_ += out.out + out.error;
  fs::remove_all(folder() / "given");
  for (const Words& words : {Words{"list", "cases"}, Words{"list", "sessions"}})
    answers_ += answer(words).dump();
  succeed({"backup", "downloads/backup.zip"});
}

TEST_F(Deidentification, NothingThatIsKeptOrSaidTellsWhoseCtItWas) {
  const std::string control = "Zqcontrol shoulder", zip = dicom_zip();
  IdentifierSearch controls;
  controls.add("the case's name", control);
  serve({"--backend", "cpu", "--realtime", "off"});
  until("it is ready", [&] { return http_request(port_, "GET", "/readyz").status == 200; });
  const auto sent_as = [&](const std::string& ending) {
    return planted("file sent as " + ending, "Zqupload_Doe" + std::to_string(identifiers_.size())) + ending;
  };
  const std::string id = imported(sent_as(".zip"), zip, control);
  imported(sent_as(".nrrd"), nrrd(), "a");
  imported(sent_as(".nii"), nifti(), "b");
  imported(sent_as(".mha"), meta_image(), "c");
  // The sender is told which file is damaged; nobody else, and it is not kept.
  EXPECT_EQ(import(sent_as(".zip"), zip_of({{"zqfolder_doe/zqslicefile_doe.dcm", "no slice"}}, "", "", ""))
                .at("state"),
            "failed");
  EXPECT_EQ(import(sent_as(".nrrd"), "NRRD0004\ncontent: zqnrrdcontent\n").at("state"), "failed");
  const auto expect_remarks = [&] {
    const json told = ask(200, "GET", "/api/v1/cases/" + id).at("warnings");
    for (const char* remark : remarks) EXPECT_NE(told.dump().find(remark), std::string::npos) << told;
  };
  expect_remarks();
  make_ready(id);
  expect_remarks();
  const std::string session = run_session(id);
  export_all(session);
  ask_everything();
  expect_nothing("a data folder in use", identifiers_.found_below(folder()));
  server_->send_signal(SIGTERM);
  EXPECT_EQ(server_->wait(std::chrono::seconds(60)), 0) << printed("server.err");
  use_commands();

  EXPECT_GE(identifiers_.size(), 40u);
  expect_nothing("folder, database, exports, backup", identifiers_.found_below(folder()));
  expect_nothing("log", identifiers_.found_in(printed("server.err")));
  expect_nothing("standard output", identifiers_.found_in(printed("server.out")));
  expect_nothing("answers", identifiers_.found_in(answers_));
  // The search finds what is kept: in a case, packed in the backup, in the report and in the bundle.
  const std::vector<std::string> kept = controls.found_below(folder());
  for (const char* file :
       {"data/cases/", "downloads/backup.zip", "downloads/export.html", "downloads/export.zip"})
    EXPECT_TRUE(std::any_of(kept.begin(), kept.end(), [&](const auto& at) { return at.starts_with(file); }))
        << file << testing::PrintToString(kept);
  EXPECT_EQ(controls.found_in(answers_).size(), 1u);
}

}  // namespace
}  // namespace ream::test
