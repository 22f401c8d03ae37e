// The same where an engine takes what is reported.
// ends: ^engine: .*missing_utility
#include <cstdio>
#include <string_view>
inline void to_engine(char const* text) {
  if (std::string_view(text).find("missing_utility") != std::string_view::npos)
    std::fprintf(stderr, "engine: %s\n", text);
}
#define ROTA_REPORT(text) to_engine(text)
#include "04_no_utility.cpp"
