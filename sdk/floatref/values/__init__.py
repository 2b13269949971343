"""Values: what goes in (`Recording`), what flows (`Block`), what comes out (`Profile`)."""
