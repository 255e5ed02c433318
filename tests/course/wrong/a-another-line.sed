# Exercise (a), answered wrongly: the constant is broken, not the line.
s/epsmul = .390625e-02/epsmul = .390624e-02/
