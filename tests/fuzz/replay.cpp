// Runs each file of some folders through one fuzzing program, where there is no libFuzzer. Says how many.
#include "input.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

int main(int argc, char** argv) {
  std::vector<std::filesystem::path> files;
  for (int i = 1; i < argc; ++i)
    for (auto const& e : std::filesystem::directory_iterator(argv[i]))
      if (e.is_regular_file()) files.push_back(e.path());
  std::sort(files.begin(), files.end());
  for (auto const& f : files) {
    std::fprintf(stderr, "%s\n", f.string().c_str());  // the last one named is the one that broke
    std::ifstream in(f, std::ios::binary);
    std::vector<char> const bytes{std::istreambuf_iterator<char>(in), {}};
    LLVMFuzzerTestOneInput(reinterpret_cast<std::uint8_t const*>(bytes.data()), bytes.size());
  }
  std::printf("%zu files, nothing broken\n", files.size());
  return files.empty() ? 1 : 0;
}
