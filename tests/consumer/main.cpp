#include <rota/rota.hpp>

#if __cplusplus < 202002L
#error "linking rota::rota must ask for C++20"
#endif

#if defined(WITH_COMPONENTS) && !__has_include(<Eigen/Core>)
#error "linking rota::adapters must bring Eigen"
#endif

int main() {}
