#!/usr/bin/env bash
# Installs the Debian packages that stride is built with, those that are missing. Sourced by the other scripts.

packages_build=(
  ca-certificates ccache cmake g++ git ninja-build pkg-config
  libarchive-dev libboost-dev libcli11-dev libeigen3-dev libfmt-dev libjpeg62-turbo-dev libmd-dev
  libmujoco-dev libosmesa6 libpagmo-dev librandom123-dev libseccomp-dev libspdlog-dev libstb-dev libsystemc-dev libtinygltf-dev libtinyxml2-dev
  libutfcpp-dev nlohmann-json3-dev zlib1g-dev
)
packages_test=(
  binutils catch2 chromium chromium-driver clang-format-14 dpkg-dev fish fonts-dejavu-core gtkwave libbenchmark-dev
  libpython3.11 libxml2-utils mandoc mold munge openssh-client openssh-server parallel python3 python3-venv python3-pip
  slurm-client slurmctld slurmd unzip zip zsh
)
packages_fuzz=(clang-14 libclang-rt-14-dev)

# Node.js of another origin brings an npm of its own, beside which Debian's cannot be installed.
command -v npm >/dev/null || packages_build+=(npm)

# install_packages NAME...
install_packages() {
  local missing=() name
  for name in "$@"; do
    dpkg-query -W -f '${Status}' "$name" 2>/dev/null | grep -q 'install ok installed' || missing+=("$name")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  local sudo=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
      echo "stride: these packages are missing and there is no sudo to install them: ${missing[*]}" >&2
      return 1
    }
    sudo=(sudo)
  fi
  echo "Installing ${missing[*]}"
  "${sudo[@]}" apt-get update -qq
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
}
