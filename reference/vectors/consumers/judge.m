% Judges a kernel in Octave: octave --quiet judge.m ../contct-vectors-1.txt. Put yours in the place of contct.
% Exit status 0: equal to the bit in every call; 1: not, or nothing was compared.
1;

function [smin, ss, isep] = contct (d, response, face, isep, isurf)
  DELTA = 1e-20; EPSGAP = 1e-10; EPSMUL = 0.390625e-02;
  gap = face - d;
  ss = gap ./ response;
  check = isep .* isurf ./ response;
  near = abs (gap) < EPSGAP;
  ss(near & check > 0) = check(near & check > 0) * DELTA;
  ss(response == 0 | (near & ! (check > 0))) = 1;
  smin = min ([1; ss(ss > 0 & ss < 1)]);
  toggled = smin != 1 & abs (ss - smin) / smin < EPSMUL;
  isep(toggled) = 1 - 2 * (isep(toggled) == 1);
endfunction

function equal = same (a, b)
  equal = (isnan (a) & isnan (b)) | typecast (a, "int64") == typecast (b, "int64");
endfunction

lines = strsplit (fileread (argv (){end}), "\n");
calls = wrong = 0; at = 2;
while at < numel (lines)
  head = strsplit (lines{at}, " "); n = str2double (head(3:10));  % call, real, indof, ndofpn, dofs, used, nc, smin
  dofs = reshape (sscanf (strjoin (lines(at+1:at+n(6)), " "), "%f"), 3, [])';
  pairs = reshape (sscanf (strjoin (lines(at+n(6)+1:at+n(6)+n(7)), " "), "%f"), 6, [])';  % id, isep, isurf, cc, ss, isep after
  at += 1 + n(6) + n(7);
  if n(2) != 8, continue, endif
  [~, row] = ismember ((pairs(:,1) - 1) * n(4) + n(3), dofs(:,1));
  [smin, ss, isep] = contct (dofs(row,2), dofs(row,3), pairs(:,4), pairs(:,2), pairs(:,3));
  found = [ss; smin; double(isep)]; expected = [pairs(:,5); n(8); pairs(:,6)];
  k = find (! same (found, expected), 1);
  if ! isempty (k)
    what = {sprintf("SS(%d)", k), "SMIN", sprintf("ISEP(%d)", k - n(7) - 1)}{1 + (k > n(7)) + (k > n(7) + 1)};
    if wrong == 0, printf ("%s, call %d: found %s %.17g, expected %.17g\n", head{2}, n(1), what, found(k), expected(k)); endif
    wrong += 1;
  endif
  calls += 1;
endwhile
printf ("%d calls, %d differ\n", calls, wrong);
exit (calls == 0 || wrong > 0);
