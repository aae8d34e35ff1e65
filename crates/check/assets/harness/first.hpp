// Where this is included first, GCC takes no other header as somebody compiled it.
