#include "all_headers.hpp"

int the_other_unit_with_all_headers();
int the_other_unit_with_all_headers() { return 1; }
