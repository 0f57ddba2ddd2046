#!/usr/bin/env bash
# Runs a command where nothing is installed but Python and what each manylinux system has: in a root file system made of
# these files alone, with the folder at its own place, where it can be written.
#   clean_root.sh FOLDER COMMAND...
# Exit code 77 = this system allows no such root file system.
set -euo pipefail

libraries=/usr/lib/x86_64-linux-gnu
# the C library, those of GCC, zlib and expat are in the policy of manylinux; libffi is a part of Python, for its ctypes
permitted=(libc.so.6 libm.so.6 libmvec.so.1 libdl.so.2 libpthread.so.0 librt.so.1 libutil.so.1 libresolv.so.2
  libstdc++.so.6 libgcc_s.so.1 libz.so.1 libexpat.so.1 libffi.so.8)

if [ "$1" != --inside ]; then
  as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(--map-root-user)
  unshare "${as_root[@]}" --mount true || { echo "SKIPPED: this system allows no mounts of one's own"; exit 77; }
  exec unshare "${as_root[@]}" --mount "$0" --inside "$@"
fi

folder=$2
shift 2
root=$folder/root
mkdir -p "$root"
mount -t tmpfs none "$root"
mkdir -p "$root/usr/bin" "$root/usr/lib64" "$root$libraries" "$root/tmp"
ln -s usr/bin usr/lib usr/lib64 "$root"
cp /lib64/ld-linux-x86-64.so.2 "$root/usr/lib64"
cp "${permitted[@]/#/$libraries/}" "$root$libraries"
cp "$(readlink -f /usr/bin/python3)" "$root/usr/bin"
ln -s "$(basename "$root"/usr/bin/python3*)" "$root/usr/bin/python3"
for bound in /usr/lib/python3.* /usr/share/python-wheels /dev /proc; do
  mkdir -p "$root$bound"
  mount --rbind "$bound" "$root$bound"
done
mkdir -p "$root$folder"
mount --bind "$folder" "$root$folder"
exec env -i HOME="$folder" PATH=/usr/bin /usr/bin/unshare --root "$root" --wd "$folder" "$@"
