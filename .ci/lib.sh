# Shared by examples/run, tests/run, benchmarks/run and .ci/run. Source it; it moves to the top of the checkout.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export DEBIAN_FRONTEND=noninteractive

compiler_packages=(g++ cmake ninja-build)
library_packages=(libboost-dev libeigen3-dev nlohmann-json3-dev libpugixml-dev libcli11-dev)
test_packages=(libgtest-dev librapidcheck-dev z3 spin libglpk-dev meson pkg-config)
benchmark_packages=(libbenchmark-dev libroaring-dev)
# Of the allocation search; about 50 MB and 93 packages on a bare machine, most of them what libgecode-dev draws in.
peer_packages=(liblemon-dev libglpk-dev coinor-libcbc-dev libgecode-dev toulbar2 gringo)
# Of tests/floor; about 500 MB on a bare machine, most of it the cross compilers.
floor_packages=(g++-11 clang-15 clang-16 clang-19 libc++-19-dev libc++abi-19-dev g++-aarch64-linux-gnu g++-i686-linux-gnu
  gcc-arm-none-eabi libstdc++-arm-none-eabi-newlib qemu-user)
heavy_packages=(clang-19 libclang-rt-19-dev clang-format-19 clang-tidy-19 git)

say() { printf '\n== %s\n' "$*"; }
fail() { printf '%s\n' "$@" >&2; exit 2; }

# need PACKAGE...: installs those that are missing. Where all are there, apt is not even asked.
need() {
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null || {
    [[ -n ${ROTA_SKIP_PACKAGES:-} ]] && return
    fail "This script installs packages on Debian 12 only. Install the equivalents of: $*" \
      "and call it again with ROTA_SKIP_PACKAGES=1."
  }
  local package missing=()
  for package; do
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
  done
  ((${#missing[@]})) || return 0

  local root=()
  if ((EUID != 0)); then
    # Without a terminal nobody could answer sudo's question, so it must not ask one.
    if command -v sudo >/dev/null && { [[ -t 0 ]] || sudo -n true 2>/dev/null; }; then
      root=(sudo DEBIAN_FRONTEND=noninteractive)
    else
      fail "Missing packages, and neither root nor sudo to install them. Run as root:" \
        "  apt-get update && apt-get install -y --no-install-recommends ${missing[*]}"
    fi
  fi
  local log=
  log=$(mktemp)
  say "Installing ${missing[*]}"
  "${root[@]}" apt-get update -qq >"$log" 2>&1 || fail "$(cat "$log")" "apt-get update failed: is the network up?"
  "${root[@]}" apt-get install -y --no-install-recommends --print-uris "${missing[@]}" 2>/dev/null |
    awk "/^'/ { n++; bytes += \$3 } END { printf \"%d packages, %.0f MB to download\\n\", n, bytes / 1e6 }"
  "${root[@]}" apt-get install -y --no-install-recommends "${missing[@]}" >"$log" 2>&1 ||
    fail "$(tail -20 "$log")" "apt-get install failed; the whole log is $log."
  rm -f "$log"
}

# configure PRESET [OPTION...]
configure() {
  local preset=$1
  shift
  if command -v ccache >/dev/null; then export CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER-ccache}; fi
  mkdir -p build
  cmake --preset "$preset" "$@" >"build/$preset.log" 2>&1 ||
    fail "$(cat "build/$preset.log")" "Configuring failed. If the folder was moved: rm -r build/$preset and try again."
}

# build PRESET [TARGET...]: configures when there is nothing yet or the presets have changed; the rest ninja knows.
build() {
  local preset=$1 stamp=build/$1/build.ninja
  shift
  if [[ ! -f $stamp || $stamp -ot CMakePresets.json ]]; then configure "$preset"; fi
  cmake --build "build/$preset" --parallel "$(nproc)" ${1+--target "$@"} ||
    fail "Building build/$preset failed; the first error above says where."
}
