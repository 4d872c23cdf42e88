// Empty: carries the precompiled headers of the tests.
