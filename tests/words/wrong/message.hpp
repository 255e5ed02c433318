// An oracle in a comment is no sentence for users, and "oracle" is a value of a file.
inline const char* const value = "oracle";
inline const char* const words =
    "what the repaired "
    "rule does";
