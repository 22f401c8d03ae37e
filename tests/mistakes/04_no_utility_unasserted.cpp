// The same where assertions are off.
// ends: missing_utility
#define NDEBUG
#include "04_no_utility.cpp"
