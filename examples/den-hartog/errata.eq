# No formula of the note was found wrong.
