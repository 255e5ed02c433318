# Functions of debian.sh and adopt.sh, which set $title and source this file. They make a bare Debian like this system
# in the folder $root. File systems are mounted in a private namespace, so that they disappear when the script ends.
if [ "${CONTCT_NAMESPACE:-}" != own ] && [ "$(id -u)" = 0 ]; then
  # In a chroot without its own mount, mounts cannot be made private; they are unmounted at the end.
  for propagation in private unchanged; do
    ! unshare --mount --propagation $propagation true 2>/dev/null ||
      CONTCT_NAMESPACE=own exec unshare --mount --propagation $propagation sh "$0" "$@"
  done
  echo "$title: SKIPPED: no private mounts are allowed here"
  exit 77
fi
sources=/etc/apt/sources.list.d/debian.sources

. "$(dirname "$0")/said.sh"
skip() { echo "$title: SKIPPED: $1"; exit 77; }
# value NAME: prints a value of /etc/os-release.
value() { sed -n "s/^$1=\"\{0,1\}\([^\"]*\)\"\{0,1\}$/\1/p" /etc/os-release; }
can_be_bare() {
  [ "$(value ID)" = debian ] || skip "this system is not Debian"
  [ "$(id -u)" = 0 ] || skip "only root can make a bare Debian"
  [ -f $sources ] || skip "there is no file $sources"
}
remove_root() {
  umount "$root/proc" "$root/dev" 2>/dev/null
  rm -rf --one-file-system "$root"
}

# make_bare TAR: makes a bare Debian. TAR keeps its base for the next time. The output of debootstrap goes to $log.
make_bare() {
  remove_root
  if [ ! -s "$1" ]; then
    mirror=$(sed -n 's/^URIs: *//p' $sources | head -n 1)
    debootstrap --variant=minbase --include=ca-certificates "$(value VERSION_CODENAME)" "$root" "$mirror" >"$log" 2>&1 ||
      { tail -n 5 "$log"; skip "debootstrap finds no Debian at $mirror"; }
    umount "$root/proc" "$root/sys" 2>/dev/null  # debootstrap may leave these mounted
    tar -C "$root" --one-file-system -cf "$1.part" . && mv "$1.part" "$1" || exit 1
  else
    mkdir -p "$root" && tar -C "$root" -xf "$1" || exit 1
  fi
  # Copies this system's network and apt settings.
  cp /etc/hosts /etc/resolv.conf "$root/etc/" && rm -f "$root/etc/apt/sources.list" &&
    cp $sources "$root/etc/apt/sources.list.d/" && cp -r /etc/apt/apt.conf.d "$root/etc/apt/" || exit 1
  [ ! -d /usr/local/share/ca-certificates ] || cp -r /usr/local/share/ca-certificates "$root/usr/local/share/"
  mount -t proc proc "$root/proc" && mount -t tmpfs tmpfs "$root/dev" || exit 1
  for device in null zero full random urandom tty; do cp -a "/dev/$device" "$root/dev/$device"; done
  ln -s /proc/self/fd "$root/dev/fd"
}

# in_bare COMMAND..: runs a command in the bare Debian.
in_bare() {
  env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive chroot "$root" "$@"
}
