# Exercise (a), answered wrongly: a name that nothing declares.
s/< epsmul) isep/< epsmal) isep/
