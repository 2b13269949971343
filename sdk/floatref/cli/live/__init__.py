"""`floatref live`: profiles while another program sends samples."""
