// A name that would be cut in two: names.cmake must notice.
TEST_CASE("one fact; and another") {}
