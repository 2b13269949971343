"""A stream served to another program: messages in, answers out, a directory that survives both."""
