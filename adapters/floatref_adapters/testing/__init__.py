"""Writers of native formats, for tests."""
