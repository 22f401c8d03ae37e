// One of two units of a program, each compiled with flags of its own. UNIT is its name.
#include "floor/unit.hpp"
#include "search/digest/digest.hpp"

answers UNIT() { return {digest::compute(), digest::compute_of_pairs(), rota::search_budget{}.audit}; }
