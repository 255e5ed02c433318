# Exercise (a), answered wrongly: two traces notice.
s/< epsmul) isep/< .99 * epsmul) isep/
