"""States, constants and values of both filters, field by field; nothing compiled."""
