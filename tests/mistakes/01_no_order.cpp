// The agent type of the vocabulary has == and <, but no <=>.
// fails: three_way_comparison_is_missing_in<number>
// fails: error.*this identifier has == and <, but not <=, >, >=
#include <rota/model/team.hpp>

struct number {
  int value = 0;
  friend bool operator==(number, number) = default;
  friend bool operator<(number a, number b) { return a.value < b.value; }
};
struct loose {
  using agent = number;
  enum class plan_type {};
  enum class plan {};
  enum class task {};
  enum class state {};
};

int main() { rota::team<loose> members; }
