#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "access/signed_release.hpp"
#include "app/cli/commands.hpp"
#include "core/text.hpp"

namespace ream::app {
namespace {

void verify(const std::filesystem::path& folder, const std::string& key, bool for_programs) {
  const access::SignedRelease release = access::verify_release(folder, key);
  if (for_programs) {
    std::cout << nlohmann::json{{"verified", true},
                                {"key", release.key},
                                {"comment", release.comment},
                                {"files", release.files}}
                     .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
              << '\n';
    return;
  }
  for (const std::string& name : release.files) std::cout << one_line(name, 200) << '\n';
  std::cout << release.files.size() << " files are as they were released, signed with the key " << release.key
            << ": " << one_line(release.comment, 200) << '\n';
}

}  // namespace

void add_verify_release_command(CLI::App& app, GlobalOptions& global) {
  struct Options {
    std::filesystem::path folder;
    std::string key;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("verify-release", "Tell whether a release's files are those that were signed");
  command->add_option("folder", options->folder, "Folder with the files, SHA256SUMS and SHA256SUMS.minisig")
      ->required();
  command
      ->add_option("--key", options->key, "minisign's public key of who releases: a file, or the key itself")
      ->required();
  command->callback([options, &global] { verify(options->folder, options->key, global.json); });
}

}  // namespace ream::app
