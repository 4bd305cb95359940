#!/usr/bin/env bash
# Installs a Debian package of mpfem in a bare Debian 12 and uses it there: needs root, debootstrap and a mirror.
#
#   try-package.sh PACKAGE.deb [ROOT]     ROOT: folder for the bare system, made if it is not there (300 MB) and kept;
#                                         without it a temporary one
#
# Exit code 0: installed by apt with what it depends on, no program beyond x86-64-v2 but those that are called where the
# processor has more, and with each of these the steps from sizes to a curve.
set -euo pipefail

package=$(realpath "$1")
root=${2:-}
temporary=
[[ -n $root ]] || temporary=$(mktemp -d)
root=${root:-$temporary}
# mpfem finds the executables of newer processors next to its own by /proc.
clean_up() {
  ! mountpoint -q "$root/proc" || umount "$root/proc"
  [[ -z $temporary ]] || rm -rf "$temporary"
}
trap clean_up EXIT
fail() {
  printf 'try-package: %s\n' "$*" >&2
  exit 1
}

if [[ ! -e $root/etc/debian_version ]]; then
  debootstrap --variant=minbase bookworm "$root" http://deb.debian.org/debian >"$root.debootstrap.log"
  rm -f "$root.debootstrap.log"
fi
# All that the bare system takes from this one besides the package.
cp /etc/resolv.conf "$root/etc/resolv.conf"
cp "$package" "$root/mpfem.deb"
in_root() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 "$@"; }

mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"

in_root apt-get update -q >/dev/null
in_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends --reinstall ./mpfem.deb \
  >/dev/null

# Registers ymm and zmm are of AVX and AVX-512.
for program in mpfem pack-gen postproc; do
  in_root "$program" --version
  wide=$(objdump -d --no-show-raw-insn "$root/usr/bin/$program" | grep -cE '%[yz]mm' || true)
  ((wide == 0)) || fail "$program has $wide instructions beyond x86-64-v2"
done
for level in v3 v4; do [[ -x $root/usr/bin/mpfem-$level ]] || fail "mpfem-$level is missing"; done

levels=(v2)
known=$(in_root /lib64/ld-linux-x86-64.so.2 --help) # the loader names the levels that this processor has
for level in v3 v4; do
  [[ $known != *"x86-64-$level (supported"* ]] || levels+=("$level")
done
# shellcheck disable=SC2016 # these expand in the shell of the bare system
in_root sh -eu -c '
  mkdir -p /root/try && cd /root/try
  example=/usr/share/mpfem/studies/packings/mcc_ph102_smoke.toml
  quietly() { "$@" >log.txt 2>&1 || { cat log.txt >&2; exit 1; }; }
  quietly pack-gen spheres $example -o spheres.h5
  quietly pack-gen mesh spheres.h5 --size 0.04 -o packing.h5
  for level in "$@"; do
    export MPFEM_INSTRUCTION_SET=$level
    quietly mpfem run /usr/share/mpfem/studies/branches/press-and-crush.toml \
      --set packing=packing.h5 --set stages.0.mean_stress=2 --set stages.3.axial_strain=0.02 \
      --set bond.fracture_energy=0.05 \
      --threads 1 -o run-$level.h5
    quietly postproc curve run-$level.h5 -o curve-$level.csv
    echo "$level: $(grep -c . curve-$level.csv) rows of a curve"
  done
  quietly postproc view run-v2.h5 -o view.html
  test -s view.html' sh "${levels[@]}"
echo "try-package: $(basename "$package") installs and runs, with ${levels[*]}"
