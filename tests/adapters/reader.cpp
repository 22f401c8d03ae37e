#include "sandbox.hpp"

#include <rota/adapters/alica.hpp>

namespace rota::test {

alica::model load(std::vector<fs::path> const& paths, alica::load_options const& limits) {
  return alica::load(paths, limits);
}

alica::detail::draft read_document(std::string_view bytes, alica::file_kind kind) {
  return alica::detail::read_document(bytes, kind);
}

}  // namespace rota::test
