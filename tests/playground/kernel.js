function contct(dd, dtest, cc, ss, id, isep, isurf, nc, indof, ndofpn) {
  let smin = 1;
  for (let i = 0; i < nc; ++i) {
    const dof = (id[i] - 1) * ndofpn + indof - 1;
    const gap = cc[i] - dd[dof];
    if (dtest[dof] === 0) ss[i] = 1;
    else if (Math.abs(gap) < 1e-10) {
      const sschk = (isep[i] * isurf[i]) / dtest[dof];
      ss[i] = sschk > 0 ? sschk * 1e-20 : 1;
    } else ss[i] = gap / dtest[dof];
    if (ss[i] > 0 && ss[i] < smin) smin = ss[i];
  }
  if (smin === 1) return smin;
  for (let i = 0; i < nc; ++i) {
    const diff = Math.abs(ss[i] - smin) / smin;
    if (diff < 1 / 256) isep[i] = isep[i] === 1 ? -1 : 1;
  }
  return smin;
}
